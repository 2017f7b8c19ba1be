"""glTF files of every kind that Debian's packages lack, written without the engine."""

import base64
import json
import struct
from pathlib import Path
from typing import Any, Dict, List

import numpy as np

_KINDS = {"f4": 5126, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125}


class Writer:
    def __init__(self) -> None:
        self.data = b""
        self.json: Dict[str, Any] = {
            "asset": {"version": "2.0", "generator": "a test"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "bufferViews": [],
            "accessors": [],
        }

    def view(self, data: bytes, **members: Any) -> int:
        self.data += b"\0" * (-len(self.data) % 4)
        self.json["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data), **members}
        )
        self.data += data
        return len(self.json["bufferViews"]) - 1

    def accessor(self, **members: Any) -> int:
        self.json["accessors"].append(members)
        return len(self.json["accessors"]) - 1

    def numbers(self, values: Any, kind: str = "f4", shape: str = "VEC3", bounds: bool = False) -> int:
        array = np.asarray(values, "<" + kind)
        members: Dict[str, Any] = {}
        if bounds:
            flat = array.reshape(len(array), -1)
            members = {"min": flat.min(0).tolist(), "max": flat.max(0).tolist()}
        target = {} if shape == "MAT4" or shape == "SCALAR" and kind == "f4" else {
            "target": 34963 if shape == "SCALAR" else 34962
        }
        return self.accessor(
            bufferView=self.view(array.tobytes(), **target),
            componentType=_KINDS[kind],
            count=len(array),
            type=shape,
            **members,
        )

    def glb(self, path: Path) -> Path:
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        size = 12 + 8 + len(text) + 8 + len(data)
        path.write_bytes(
            struct.pack("<4sII", b"glTF", 2, size)
            + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(data), b"BIN\0") + data
        )
        return path

    def gltf(self, path: Path, embedded: bool) -> Path:
        uri = path.stem + " numbers.bin"
        if embedded:
            uri = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        else:
            (path.parent / uri).write_bytes(self.data)
            uri = uri.replace(" ", "%20")
        self.json["buffers"] = [{"byteLength": len(self.data), "uri": uri}]
        path.write_text(json.dumps(self.json, indent=2))
        return path


def tube(rings: int = 21, around: int = 16):
    """A tube with a seam in its texture: vertices at the seam stand twice in the file."""
    u, v = np.meshgrid(np.linspace(0, 1, around + 1), np.linspace(0, 1, rings))
    angle = 2.0 * np.pi * (u % 1.0)
    points = np.stack([np.cos(angle), np.sin(angle), 6.0 * v], -1).reshape(-1, 3)
    normals = points * [1, 1, 0]
    tangents = np.stack([-np.sin(angle), np.cos(angle), 0 * u, 1 + 0 * u], -1).reshape(-1, 4)
    uvs = np.stack([u, v], -1).reshape(-1, 2)
    k = np.arange(rings * (around + 1)).reshape(rings, around + 1)
    a, b, c, d = (part.ravel() for part in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    faces = np.stack([a, b, c, a, c, d], -1).reshape(-1)
    return points.astype("f4"), normals.astype("f4"), tangents.astype("f4"), uvs.astype("f4"), faces


def _plain(w: Writer) -> Dict[str, int]:
    points, normals, tangents, uvs, _ = tube()
    return {
        "POSITION": w.numbers(points, bounds=True),
        "NORMAL": w.numbers(normals),
        "TANGENT": w.numbers(tangents, shape="VEC4"),
        "TEXCOORD_0": w.numbers(uvs, shape="VEC2"),
    }


def _finish(w: Writer, primitives: List[Dict[str, Any]], **node: Any) -> Writer:
    w.json["meshes"] = [{"name": "Tube", "primitives": primitives}]
    w.json["nodes"] = [{"mesh": 0, "name": "Tube", **node}]
    return w


def _indices(w: Writer) -> int:
    return w.numbers(tube()[4], "u2", "SCALAR")


def plain() -> Writer:
    w = Writer()
    return _finish(w, [{"attributes": _plain(w), "indices": _indices(w)}])


def transformed() -> Writer:
    w = plain()
    w.json["nodes"] = [
        {"children": [1], "rotation": [0.5, 0.5, 0.5, 0.5], "translation": [3, 4, 5]},
        {"mesh": 0, "name": "Tube", "scale": [2, -1.5, 0.25], "translation": [1, 0, 0]},
    ]
    return w


def two_materials() -> Writer:
    w = Writer()
    attributes, faces = _plain(w), tube()[4].reshape(-1, 3)
    half = len(faces) // 2
    w.json["materials"] = [{"name": "wool"}, {"name": "wax", "doubleSided": True}]
    return _finish(w, [
        {"attributes": attributes, "indices": w.numbers(f.ravel(), "u2", "SCALAR"), "material": m}
        for m, f in enumerate([faces[:half], faces[half:]])
    ])


def interleaved() -> Writer:
    w = Writer()
    points, normals, _, uvs, _ = tube()
    rows = np.concatenate([points, normals, uvs], 1).astype("<f4")
    view = w.view(rows.tobytes(), byteStride=32, target=34962)
    attributes = {}
    for name, offset, shape in (("POSITION", 0, "VEC3"), ("NORMAL", 12, "VEC3"), ("TEXCOORD_0", 24, "VEC2")):
        bounds = {}
        if name == "POSITION":
            bounds = {"min": points.min(0).tolist(), "max": points.max(0).tolist()}
        attributes[name] = w.accessor(
            bufferView=view, byteOffset=offset, componentType=5126, count=len(rows), type=shape, **bounds
        )
    return _finish(w, [{"attributes": attributes, "indices": _indices(w)}])


def sparse() -> Writer:
    w = Writer()
    points = tube()[0]
    chosen = np.arange(5, len(points), 7)
    moved = points.copy()
    moved[chosen] *= [1.25, 1.25, 1]
    base = w.view(points.tobytes())
    position = w.accessor(
        bufferView=base, componentType=5126, count=len(points), type="VEC3",
        min=moved.min(0).tolist(), max=moved.max(0).tolist(),
        sparse={
            "count": len(chosen),
            "indices": {"bufferView": w.view(chosen.astype("<u2").tobytes()), "componentType": 5123},
            "values": {"bufferView": w.view(moved[chosen].astype("<f4").tobytes())},
        },
    )
    return _finish(w, [{"attributes": {"POSITION": position}, "indices": _indices(w)}])


def quantized() -> Writer:
    w = Writer()
    points = tube()[0]
    rows = np.zeros((len(points), 4), "<i2")
    rows[:, :3] = np.round(points / 8.0 * 32767)
    position = w.accessor(
        bufferView=w.view(rows.tobytes(), byteStride=8, target=34962), componentType=5122,
        normalized=True, count=len(rows), type="VEC3",
        min=rows[:, :3].min(0).tolist(), max=rows[:, :3].max(0).tolist(),
    )
    w.json["extensionsUsed"] = w.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    return _finish(w, [{"attributes": {"POSITION": position}, "indices": _indices(w)}], scale=[8, 8, 8])


def morphed() -> Writer:
    w = Writer()
    points = tube()[0]
    targets = [
        {"POSITION": w.numbers((points * [0.3, 0, 0]).astype("f4"), bounds=True)},
        {"POSITION": w.numbers((points * [0, 0, 0.1]).astype("f4"), bounds=True)},
    ]
    primitive = {"attributes": _plain(w), "indices": _indices(w), "targets": targets}
    _finish(w, [primitive])
    w.json["meshes"][0]["weights"] = [0, 0.5]
    w.json["meshes"][0]["extras"] = {"targetNames": ["wide", "long"]}
    times = w.numbers(np.array([0, 1]), shape="SCALAR", bounds=True)
    weights = w.numbers(np.array([0, 0, 1, 0.5]), shape="SCALAR")
    w.json["animations"] = [{
        "samplers": [{"input": times, "output": weights}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
    }]
    return w


def skinned() -> Writer:
    w = Writer()
    points = tube()[0]
    attributes = _plain(w)
    joints = np.zeros((len(points), 4), "u1")
    joints[:, 1] = 1
    share = points[:, 2] / 6.0
    weights = np.stack([1 - share, share, 0 * share, 0 * share], -1).astype("f4")
    attributes["JOINTS_0"] = w.numbers(joints, "u1", "VEC4")
    attributes["WEIGHTS_0"] = w.numbers(weights, shape="VEC4")
    inverse = np.array([np.eye(4), np.eye(4)], "f4")
    inverse[1, 3, 2] = -3  # columns first
    _finish(w, [{"attributes": attributes, "indices": _indices(w)}], skin=0)
    w.json["nodes"] += [{"children": [2], "name": "root"}, {"translation": [0, 0, 3], "name": "tip"}]
    w.json["scenes"] = [{"nodes": [0, 1]}]
    w.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": w.numbers(inverse, shape="MAT4")}]
    times = w.numbers(np.array([0, 1]), shape="SCALAR", bounds=True)
    turns = w.numbers(np.array([[0, 0, 0, 1], [0.6, 0, 0, 0.8]]), shape="VEC4")
    del w.json["bufferViews"][-1]["target"]
    w.json["animations"] = [{
        "samplers": [{"input": times, "output": turns}],
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}],
    }]
    return w


def unknown() -> Writer:
    """With what nobody knows: extensions, extras, attributes of an application."""
    w = plain()
    w.json["extensionsUsed"] = ["EXT_of_nobody"]
    w.json["extensions"] = {"EXT_of_nobody": {"min": [9, 9, 9], "text": "\"accessors\":[{}] \u00e9"}}
    w.json["meshes"][0]["primitives"][0]["attributes"]["_WETNESS"] = w.numbers(
        tube()[0][:, 2], shape="SCALAR")
    del w.json["bufferViews"][-1]
    w.json["bufferViews"].append({"buffer": 0, "byteOffset": 0, "byteLength": len(tube()[0]) * 4})
    w.json["extras"] = {"notes": [1, 2.50, 1e3]}
    return w


ALL = {f.__name__: f for f in (
    plain, transformed, two_materials, interleaved, sparse, quantized, morphed, skinned, unknown)}


def write_all(folder: Path) -> List[Path]:
    files = []
    for name, make in ALL.items():
        files.append(make().glb(folder / f"{name}.glb"))
        files.append(make().gltf(folder / f"{name}.gltf", False))
        files.append(make().gltf(folder / f"{name}-embedded.gltf", True))
    return files
