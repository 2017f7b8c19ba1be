"""Mesh files and generated meshes."""

from __future__ import annotations

import os
from typing import Any, List

from . import _core
from ._arguments import mesh_of


def read(path: Any) -> _core.Mesh:
    """Reads an OBJ, OFF, PLY, STL or glTF file, with all its data."""
    return _core.read(os.fspath(path))


def write(path: Any, mesh: Any, faces: Any = None) -> List[str]:
    """Writes a mesh in the format of the extension, and replaces the file in one step. A mesh that
    was read keeps the data of its file. Returns notes, for example on what the format cannot hold.
    """
    return _core.write(mesh_of(mesh, faces, "write: mesh"), os.fspath(path))


def shape(name: str) -> _core.Mesh:
    """Returns a generated mesh: "tube", "sphere", "sheet", ..."""
    return _core.shape(name)
