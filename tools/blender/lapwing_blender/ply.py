# SPDX-License-Identifier: GPL-3.0-or-later
"""Binary PLY files, for exchanging meshes and their materials with the engine."""

from __future__ import annotations

import os
import re
from typing import List, Tuple

import numpy as np

from .arrays import MeshArrays
from .errors import Refusal

_TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "<i2", "int16": "<i2",
    "ushort": "<u2", "uint16": "<u2", "int": "<i4", "int32": "<i4", "uint": "<u4",
    "uint32": "<u4", "float": "<f4", "float32": "<f4", "double": "<f8", "float64": "<f8",
}
_LIST = re.compile(r"property list (\w+) (\w+) (\w+)")


def write_ply(path: str, mesh: MeshArrays) -> None:
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        f"element vertex {len(mesh.vertices)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(mesh.sizes)}\n"
        "property list uint uint vertex_indices\nproperty uint material\nend_header\n"
    )
    # All numbers have 32 bits. A face consists of its size, its corners and its material.
    starts = mesh.starts
    words = np.insert(mesh.corners.astype("<u4"), starts, mesh.sizes)
    ends = starts + mesh.sizes + np.arange(1, len(mesh.sizes) + 1)
    words = np.insert(words, ends, mesh.materials)
    with open(path, "wb") as file:
        file.write(header.encode("ascii"))
        file.write(np.ascontiguousarray(mesh.vertices, "<f8").tobytes())
        file.write(words.astype("<u4").tobytes())


def _elements(header: str) -> List[Tuple[str, int, List[str]]]:
    elements: List[Tuple[str, int, List[str]]] = []
    for line in header.splitlines():
        if line.startswith("element "):
            _, name, count = line.split()
            elements.append((name, int(count), []))
        elif line.startswith("property "):
            elements[-1][2].append(line)
    return elements


def _rows(properties: List[str]) -> np.dtype:
    fields = []
    for line in properties:
        _, kind, name = line.split()
        fields.append((name, _TYPES[kind]))
    return np.dtype(fields)


def read_ply(path: str, vertices_only: bool = False) -> MeshArrays:
    """Reads the engine's result for a mesh from `write_ply`."""
    with open(path, "rb") as file:
        data = file.read()
    end = data.find(b"end_header\n")
    if not data.startswith(b"ply\nformat binary_little_endian") or end < 0:
        raise Refusal(f"{os.path.basename(path)} is no binary PLY file; try the edit again")
    at = end + len(b"end_header\n")
    vertices = np.empty((0, 3))
    none = np.empty(0, np.uint32)
    for name, count, properties in _elements(data[:end].decode("ascii", "replace")):
        if name == "vertex":
            rows = np.frombuffer(data, _rows(properties), count, at)
            vertices = np.stack([rows[axis].astype(np.float64) for axis in "xyz"], axis=1)
            at += rows.nbytes
        elif name == "face" and not vertices_only:
            return _faces(data, at, count, properties, vertices)
    return MeshArrays(vertices, none, none.astype(np.int32), none.astype(np.int32))


def _faces(
    data: bytes, at: int, count: int, properties: List[str], vertices: np.ndarray
) -> MeshArrays:
    lists = [k for k, line in enumerate(properties) if _LIST.match(line)]
    assert len(lists) == 1, "the engine adds no list to a face"
    place = lists[0]
    size_type, corner_type = (np.dtype(_TYPES[t]) for t in _LIST.match(properties[place]).groups()[:2])
    before, after = _rows(properties[:place]), _rows(properties[place + 1:])
    raw = np.frombuffer(data, np.uint8, offset=at)

    # Faces have different sizes, so the start of each face depends on all previous faces.
    starts = np.empty(count, np.int64)
    sizes = np.empty(count, np.int32)
    fixed = before.itemsize + size_type.itemsize + after.itemsize
    offset = 0
    for face in range(count):
        starts[face] = offset
        size_at = at + offset + before.itemsize
        size = int.from_bytes(data[size_at:size_at + size_type.itemsize], "little")
        sizes[face] = size
        offset += fixed + size * corner_type.itemsize

    first = starts + before.itemsize + size_type.itemsize
    within = np.arange(sizes.sum()) - np.repeat(np.cumsum(sizes) - sizes, sizes)
    corner_at = np.repeat(first, sizes) + within * corner_type.itemsize
    materials = np.zeros(count, np.int32)
    ends = first + sizes * corner_type.itemsize
    if after.names and "material" in after.names:
        materials = _gather(raw, ends + after.fields["material"][1], after["material"])
    return MeshArrays(
        vertices, _gather(raw, corner_at, corner_type).astype(np.uint32), sizes,
        materials.astype(np.int32),
    )


def _gather(raw: np.ndarray, places: np.ndarray, kind: np.dtype) -> np.ndarray:
    """Returns the numbers of type `kind` that begin at these bytes."""
    picked = raw[places[:, np.newaxis] + np.arange(kind.itemsize)]
    return np.ascontiguousarray(picked).view(kind).ravel()
