"""Mesh files and generated meshes."""

from __future__ import annotations

import os
from typing import List, Mapping, Optional, Union

from . import _core
from ._arguments import mesh_of
from ._types import Array, FacesLike, MeshOrVertices

Path = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]


def read(path: Path) -> _core.Mesh:
    """Reads an OBJ, OFF, PLY, STL or glTF file, with all its data. Warns (UserWarning) if parts of
    the file are left out."""
    return _core.read(os.fspath(path))


def write(
    path: Path, mesh: MeshOrVertices, faces: Optional[FacesLike] = None,
    morph_targets: Optional[Mapping[str, Array]] = None,
) -> List[str]:
    """Writes a mesh in the format of the extension, and replaces the file in one step. A mesh that
    was read keeps the data of its file. `morph_targets`, vertices of shape (n, 3) by name, are
    added to those of a mesh that was read from a glTF file. Returns notes, for example on what the
    format cannot hold.
    """
    chosen = mesh_of(mesh, faces, "write: mesh")
    return _core.write(chosen, os.fspath(path), dict(morph_targets or {}))


def shape(name: str) -> _core.Mesh:
    """Returns the generated mesh of that name, one of `shape_names()`: "tube", "sphere", ..."""
    return _core.shape(name)


def shape_names() -> List[str]:
    """Returns the names of the meshes that `shape` generates."""
    return _core.shape_names()
