"""Mesh files and generated meshes."""

from __future__ import annotations

import os
from typing import List, Optional, Union

from . import _core
from ._arguments import mesh_of
from ._types import FacesLike, MeshOrVertices

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


def read(path: Path) -> _core.Mesh:
    """Reads an OBJ, OFF, PLY, STL or glTF file, with all its data. Warns (UserWarning) if parts of
    the file are left out."""
    return _core.read(os.fspath(path))


def write(
    path: Path, mesh: MeshOrVertices, faces: Optional[FacesLike] = None
) -> List[str]:
    """Writes a mesh in the format of the extension, and replaces the file in one step. A mesh that
    was read keeps the data of its file. Returns notes, for example on what the format cannot hold.
    """
    return _core.write(mesh_of(mesh, faces, "write: mesh"), os.fspath(path))


def shape(name: str) -> _core.Mesh:
    """Returns the generated mesh of that name, one of `shape_names()`: "tube", "sphere", ..."""
    return _core.shape(name)


def shape_names() -> List[str]:
    """Returns the names of the meshes that `shape` generates."""
    return _core.shape_names()
