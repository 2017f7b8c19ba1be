"""Mesh files and generated meshes."""

from __future__ import annotations

import os
from typing import Any, List

from . import _core
from ._arguments import mesh_of


def read(path: Any) -> _core.Mesh:
    """The mesh of an OBJ, OFF, PLY, STL or glTF file, with all that the file has."""
    return _core.read(os.fspath(path))


def write(path: Any, mesh: Any, faces: Any = None) -> List[str]:
    """Writes a mesh in the format that the extension names, replacing the file in one step. A mesh
    that was read keeps what its file had. Returns what there is to say of it: what the format has
    no place for."""
    return _core.write(mesh_of(mesh, faces, "write: mesh"), os.fspath(path))


def shape(name: str) -> _core.Mesh:
    """A generated mesh to try things on: "tube", "sphere", "sheet", ..."""
    return _core.shape(name)
