"""glTF files as another program reads them: nothing here is the engine's."""

import base64
import json
import struct
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple
from urllib.parse import unquote

import numpy as np

_TYPES = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_SHAPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_LARGEST = {5120: 127.0, 5121: 255.0, 5122: 32767.0, 5123: 65535.0}


class Document:
    """The JSON of a file, its text, and the bytes of its buffers."""

    def __init__(self, path: Path):
        self.path = Path(path)
        data = self.path.read_bytes()
        self.binary = data[:4] == b"glTF"
        self.rest = b""
        chunk = b""
        if self.binary:
            length, size = struct.unpack_from("<I", data, 8)[0], struct.unpack_from("<I", data, 12)[0]
            self.text = data[20 : 20 + size].rstrip(b" \0")
            at = 20 + size
            if at < length:
                chunk_size = struct.unpack_from("<I", data, at)[0]
                chunk = data[at + 8 : at + 8 + chunk_size]
                at += 8 + chunk_size
            self.rest = data[at:]
        else:
            self.text = data
        self.json: Dict[str, Any] = json.loads(self.text)
        self.buffers: List[bytes] = []
        for buffer in self.json.get("buffers", []):
            uri: Optional[str] = buffer.get("uri")
            if uri is None:
                self.buffers.append(chunk)
            elif uri.startswith("data:"):
                self.buffers.append(base64.b64decode(uri.split(",", 1)[1]))
            else:
                self.buffers.append((self.path.parent / unquote(uri)).read_bytes())

    def _places(self, view: int, offset: int, count: int, size: int, dense: bool) -> Tuple[int, Any]:
        v = self.json["bufferViews"][view]
        stride = v.get("byteStride", size) if dense else size
        first = v.get("byteOffset", 0) + offset
        return v["buffer"], first + stride * np.arange(count)

    def places(self, number: int) -> List[Tuple[int, int, int]]:
        """(buffer, first byte, bytes) of each element of an accessor that stands somewhere."""
        a = self.json["accessors"][number]
        size = _SHAPES[a["type"]] * np.dtype(_TYPES[a["componentType"]]).itemsize
        found = []
        if "bufferView" in a:
            buffer, at = self._places(a["bufferView"], a.get("byteOffset", 0), a["count"], size, True)
            found += [(buffer, int(k), size) for k in at]
        if "sparse" in a:
            values = a["sparse"]["values"]
            buffer, at = self._places(
                values["bufferView"], values.get("byteOffset", 0), a["sparse"]["count"], size, False
            )
            found += [(buffer, int(k), size) for k in at]
        return found

    def _numbers(self, view: int, offset: int, count: int, kind: int, width: int, dense: bool):
        dtype = np.dtype(_TYPES[kind])
        buffer, at = self._places(view, offset, count, width * dtype.itemsize, dense)
        data = self.buffers[buffer]
        return np.array([np.frombuffer(data, dtype, width, int(k)) for k in at]).reshape(count, width)

    def values(self, number: int) -> np.ndarray:
        """(count, numbers an element), whole numbers made parts of 1 where the file says so."""
        a = self.json["accessors"][number]
        width, kind = _SHAPES[a["type"]], a["componentType"]
        result = np.zeros((a["count"], width))
        if "bufferView" in a:
            result[:] = self._numbers(
                a["bufferView"], a.get("byteOffset", 0), a["count"], kind, width, True
            )
        if "sparse" in a:
            s = a["sparse"]
            i, v = s["indices"], s["values"]
            rows = self._numbers(
                i["bufferView"], i.get("byteOffset", 0), s["count"], i["componentType"], 1, False
            )[:, 0]
            result[rows.astype(int)] = self._numbers(
                v["bufferView"], v.get("byteOffset", 0), s["count"], kind, width, False
            )
        if a.get("normalized"):
            result = np.maximum(result / _LARGEST[kind], -1.0)
        return result

    def objects(self) -> List[Tuple[int, int, np.ndarray]]:
        """(node, mesh, matrix to the world) of the scene's nodes; identity for those with a skin."""
        nodes = self.json.get("nodes", [])
        if self.json.get("scenes"):
            roots = self.json["scenes"][self.json.get("scene", 0)].get("nodes", [])
        else:
            children = {c for n in nodes for c in n.get("children", [])}
            roots = [k for k in range(len(nodes)) if k not in children]
        found = []

        def walk(k: int, parent: np.ndarray) -> None:
            node = nodes[k]
            matrix = parent @ _local(node)
            if "mesh" in node:
                found.append((k, node["mesh"], np.eye(4) if "skin" in node else matrix))
            for child in node.get("children", []):
                walk(child, matrix)

        for root in roots:
            walk(root, np.eye(4))
        return found

    def primitives(self):
        """(mesh, matrix, primitive) of what has triangles and positions, for each object."""
        for _, mesh, matrix in self.objects():
            for primitive in self.json["meshes"][mesh]["primitives"]:
                if primitive.get("mode", 4) >= 4 and "POSITION" in primitive["attributes"]:
                    yield mesh, matrix, primitive


def _local(node: Dict[str, Any]) -> np.ndarray:
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    m = np.eye(4)
    x, y, z, w = np.array(node.get("rotation", [0, 0, 0, 1]), float)
    n = x * x + y * y + z * z + w * w
    m[:3, :3] = np.eye(3) + 2.0 / n * np.array(
        [
            [-(y * y + z * z), x * y - z * w, x * z + y * w],
            [x * y + z * w, -(x * x + z * z), y * z - x * w],
            [x * z - y * w, y * z + x * w, -(x * x + y * y)],
        ]
    )
    m[:3, :3] *= np.array(node.get("scale", [1, 1, 1]), float)
    m[:3, 3] = node.get("translation", [0, 0, 0])
    return m
