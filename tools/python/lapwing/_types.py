"""Types of arguments and results."""

from __future__ import annotations

from typing import (
    AbstractSet,
    Any,
    Callable,
    List,
    Literal,
    Mapping,
    Optional,
    Protocol,
    Sequence,
    Tuple,
    Union,
)

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core

Array = NDArray[Any]
#: The faces of a mesh: (m, k), or a list of polygons of different sizes.
FacesOf = Union[NDArray[np.uint32], List[NDArray[np.uint32]]]
FacesLike = Union[ArrayLike, Sequence[ArrayLike]]


class WithFaces(Protocol):
    """An object like a `trimesh.Trimesh`."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class WithTriangles(Protocol):
    """An object like an `open3d.geometry.TriangleMesh`."""

    @property
    def vertices(self) -> Any: ...
    @property
    def triangles(self) -> Any: ...


class WithTensors(Protocol):
    """An object like an `open3d.t.geometry.TriangleMesh`."""

    @property
    def vertex(self) -> Any: ...
    @property
    def triangle(self) -> Any: ...


#: A mesh as one object.
MeshLike = Union[
    _core.Mesh, _core.Result, WithFaces, WithTriangles, WithTensors, Tuple[ArrayLike, FacesLike]
]
#: The first argument of functions whose second argument may contain the faces.
MeshOrVertices = Union[MeshLike, ArrayLike]
#: "all", vertex numbers, a mask, or a region of a recipe.
Region = Union[ArrayLike, AbstractSet[int], Mapping[str, Any]]
#: A matrix of shape (4, 4) or (3, 4), or a move of a recipe.
Move = Union[ArrayLike, Mapping[str, Any]]
Handle = Union[Tuple[Region, Move], Mapping[str, Any]]
Landmarks = Tuple[ArrayLike, ArrayLike]
Progress = Optional[Callable[[str, float], Optional[bool]]]

Operation = Literal[
    "deform", "coat", "mix", "transplant", "peel", "remesh", "decimate", "subdivide",
    "fill_holes", "wrap",
]
Weights = Literal["uniform", "cotangent"]
LinearResponse = Literal["tangent", "rsi"]
Loose = Literal["carry", "leave", "refuse"]
Seams = Literal["join", "leave"]
Domain = Literal["disk", "square"]
Sampling = Literal["one_ring", "linear"]
Take = Literal["coating", "shape"]
Profile = Literal["smooth", "linear"]
Remesh = Literal["auto", "none"]
View = Literal["three-quarter", "front", "back", "left", "right", "top", "bottom"]
UpAxis = Literal["y", "z"]
Background = Literal["gradient", "white", "transparent"]
