"""Converts Python arguments to what the engine reads: meshes, and JSON of recipes."""

from __future__ import annotations

import json
import math
import numbers
import os
from typing import AbstractSet, Any, List, Mapping, Optional, Sequence

import numpy as np

from . import _core
from ._types import Array

#: Keys of a recipe, at any depth, whose values are regions.
_REGION_KEYS = frozenset(
    ["roi", "region", "source_patch", "target_patch", "patch", "target_region", "distance_to",
     "disk_in"]
)
#: Keys of a recipe whose values are lists of regions.
_REGION_LIST_KEYS = frozenset(["union", "minus"])
#: Keys of a recipe whose values are moves.
_MOVE_KEYS = frozenset(["move", "place"])


def mesh_of(mesh: Any, faces: Any = None, name: str = "mesh") -> _core.Mesh:
    """Returns the mesh of arrays, or of an object with arrays as attributes.

    Accepts a `lapwing.Mesh`, a `lapwing.Result`, (n, 3) vertices with their faces, a pair of both,
    an object with `vertices` and `faces` (trimesh) or `triangles` (Open3D), and Open3D's tensor
    meshes.
    """
    if faces is not None:
        return _core.Mesh(mesh, faces)
    if isinstance(mesh, _core.Mesh):
        return mesh
    if isinstance(mesh, _core.Result):
        return mesh.mesh
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return _core.Mesh(mesh[0], mesh[1])
    if hasattr(mesh, "vertices"):
        for attribute in ("faces", "triangles"):
            if hasattr(mesh, attribute):
                return _core.Mesh(
                    np.asarray(mesh.vertices), _faces_or_list(getattr(mesh, attribute))
                )
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):  # open3d.t.geometry
        return _core.Mesh(_numpy(mesh.vertex["positions"]), _numpy(mesh.triangle["indices"]))
    raise _core.InputError(
        f"{name}: expected vertices and faces, or an object with both as attributes, "
        f"got {type(mesh).__name__}"
    )


def _faces_or_list(faces: Any) -> Any:
    return faces if isinstance(faces, (list, tuple)) else np.asarray(faces)


def _numpy(tensor: Any) -> Array:
    return np.asarray(tensor.numpy() if hasattr(tensor, "numpy") else tensor)


def region_of(region: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts "all", a mask, vertex numbers or a recipe's region to a recipe's region. Checks the
    length of a mask if `vertex_count` is known."""
    if isinstance(region, str):
        if region != "all":
            raise _core.InputError(
                f'{where}: expected "all", vertex numbers, a mask or a region, got "{region}"'
            )
        return {"all": True}
    if isinstance(region, Mapping):
        return plain(region, vertex_count, where)
    return {"vertices": listed_vertices(region, vertex_count, where)}


def listed_vertices(region: Any, vertex_count: Optional[int], where: str) -> List[int]:
    """Returns the vertices of a mask or of a list of vertex numbers. Whole numbers are a mask if
    there is a 0 or 1 for each vertex of the mesh: as vertex numbers, these would be 0 and 1."""
    if isinstance(region, AbstractSet):
        region = sorted(region)
    vertices = np.asarray(region)
    if vertices.size == 0:
        return []
    if vertices.ndim != 1:
        raise _core.InputError(
            f"{where}: expected vertex numbers of shape (k,) or a mask of shape (n,), "
            f"got shape {vertices.shape}"
        )
    if vertices.dtype == bool:
        if vertex_count is not None and vertices.size != vertex_count:
            raise _core.InputError(
                f"{where}: expected a mask with a value for each of the {vertex_count} vertices, "
                f"got {vertices.size}"
            )
        return [int(v) for v in np.flatnonzero(vertices)]
    is_mask = (
        vertices.dtype.kind in "iu"
        and 2 < vertices.size == vertex_count
        and vertices.min() >= 0
        and vertices.max() <= 1
    )
    if is_mask:
        return [int(v) for v in np.flatnonzero(vertices)]
    return vertices_of(vertices, where)


def vertices_of(vertices: Any, where: str) -> List[int]:
    """Returns vertex numbers, in their order. Refuses repeated numbers, since labels and masks
    have them."""
    listed = np.asarray(vertices)
    if listed.size == 0:
        return []
    if listed.ndim != 1 or listed.dtype.kind not in "iu":
        raise _core.InputError(
            f"{where}: expected vertex numbers, got an array of type {listed.dtype} and shape "
            f"{listed.shape}; a mask has the type bool"
        )
    if int(listed.min()) < 0:
        place = int(np.argmin(listed))
        raise _core.InputError(
            f"{where}[{place}]: expected a vertex number from 0, got {listed[place]}"
        )
    found, counts = np.unique(listed, return_counts=True)
    if counts.max() > 1:
        first = int(found[np.argmax(counts > 1)])
        raise _core.InputError(
            f"{where}: vertex {first} is listed {counts[counts > 1][0]} times. List each vertex "
            "once, as numpy.unique does. A mask has the type bool and a value for each vertex, "
            "as in labels == 1",
            [first],
        )
    return [int(v) for v in listed.tolist()]


def move_of(move: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts a matrix of shape (4, 4) or (3, 4), or a recipe's move, to a recipe's move."""
    if isinstance(move, Mapping):
        return plain(move, vertex_count, where)
    matrix = np.asarray(move)
    if matrix.shape not in ((4, 4), (3, 4)):
        raise _core.InputError(
            f"{where}: expected a matrix of shape (4, 4) or (3, 4), or a dict such as "
            f'{{"translate": [x, y, z]}}, got shape {matrix.shape}'
        )
    return {"matrix": sum(plain(matrix, vertex_count, where), [])}


def handles_of(handles: Any, vertex_count: Optional[int], where: str) -> List[Any]:
    """Converts handles, dicts or pairs (region, move), to a recipe's handles."""
    written = []
    for k, handle in enumerate(handles):
        place = f"{where}[{k}]"
        if isinstance(handle, Mapping):
            written.append(plain(handle, vertex_count, place))
        elif isinstance(handle, (tuple, list)) and len(handle) == 2:
            written.append(
                {
                    "region": region_of(handle[0], vertex_count, place + ".region"),
                    "move": move_of(handle[1], vertex_count, place + ".move"),
                }
            )
        else:
            raise _core.InputError(
                f"{place}: expected a pair (region, move) or a dict with both keys, "
                f"got {type(handle).__name__}"
            )
    return written


def plain(value: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts `value` to JSON types: dicts, lists, text and finite numbers."""
    if value is None or isinstance(value, (str, bool, int)):
        return value
    if isinstance(value, Mapping):
        return {
            str(key): plain_of_key(str(key), each, vertex_count, f"{where}.{key}")
            for key, each in value.items()
        }
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "f" and not np.isfinite(value).all():
            place = ", ".join(str(i) for i in np.argwhere(~np.isfinite(value))[0])
            raise _core.InputError(f"{where}[{place}]: the number is not finite")
        if value.dtype.kind not in "biuf":
            raise _core.InputError(
                f"{where}: expected numbers, got an array of type {value.dtype}"
            )
        return value.tolist()
    if isinstance(value, np.generic):
        return plain(value.item(), vertex_count, where)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise _core.InputError(f"{where}: the number is not finite")
        return value
    if isinstance(value, (Sequence, set, frozenset, range)):
        kinds = set(map(type, value))
        if kinds <= {int} or (kinds <= {float} and all(map(math.isfinite, value))):
            return list(value)  # converting each element would block other threads for too long
        return [plain(each, vertex_count, f"{where}[{k}]") for k, each in enumerate(value)]
    if hasattr(value, "__array__"):
        return plain(np.asarray(value), vertex_count, where)
    raise _core.InputError(f"{where}: {type(value).__name__} cannot be written in a recipe")


def plain_of_key(key: str, value: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts the value of a recipe's key to JSON types."""
    if key == "handles":
        return handles_of(value, vertex_count, where)
    if key == "targets":
        return targets_of(value, vertex_count, where)
    if key == "landmarks":
        return wrap_landmarks_of(value, vertex_count, where)
    if key == "stiffness":
        return stiffness_of(value, vertex_count, where)
    if isinstance(value, Mapping):
        return plain(value, vertex_count, where)
    if key in _REGION_KEYS:
        return region_of(value, vertex_count, where)
    if key in _REGION_LIST_KEYS and isinstance(value, (list, tuple)):
        return [region_of(each, vertex_count, f"{where}[{k}]") for k, each in enumerate(value)]
    if key == "vertices":
        return listed_vertices(value, vertex_count, where)
    if key in _MOVE_KEYS:
        return move_of(value, vertex_count, where)
    if key == "belt":
        return belt_of(value, vertex_count, where)
    return plain(value, vertex_count, where)


def belt_of(belt: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts a belt to a recipe's belt. A number is the outer fraction of the region."""
    if isinstance(belt, numbers.Real) and not isinstance(belt, bool):
        return {"fraction": plain(belt, vertex_count, where)}
    return region_of(belt, vertex_count, where)


def targets_of(targets: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts landmarks, rows or a dict from vertices to positions, to a recipe's targets."""
    if isinstance(targets, Mapping):
        if not targets or any(isinstance(key, str) for key in targets):
            return plain(targets, vertex_count, where)
        return [
            [plain(key, vertex_count, where), *plain(np.atleast_1d(place), vertex_count, where)]
            for key, place in targets.items()
        ]
    return plain(targets, vertex_count, where)


def wrap_landmarks_of(landmarks: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts landmarks to those of a recipe: one or two paths, or what `targets_of` takes."""
    if isinstance(landmarks, (str, os.PathLike)):
        return os.fspath(landmarks)
    if isinstance(landmarks, (tuple, list)) and len(landmarks) == 2:
        if all(isinstance(path, (str, os.PathLike)) for path in landmarks):
            return {"template": os.fspath(landmarks[0]), "scan": os.fspath(landmarks[1])}
    return targets_of(landmarks, vertex_count, where)


def stiffness_of(stiffness: Any, vertex_count: Optional[int], where: str) -> Any:
    """Converts an array with the factor of each vertex, or dicts, to a recipe's stiffness."""
    if isinstance(stiffness, (list, tuple)) and any(isinstance(s, Mapping) for s in stiffness):
        return [_stiff_part(s, vertex_count, f"{where}[{k}]") for k, s in enumerate(stiffness)]
    return [{"region": {"all": True}, "factor": _factors_of(stiffness, vertex_count, where)}]


def _stiff_part(part: Any, vertex_count: Optional[int], where: str) -> Any:
    written = dict(part)
    if written.get("factor") == math.inf:
        written["factor"] = "rigid"
    return plain(written, vertex_count, where)


def _factors_of(factors: Any, vertex_count: Optional[int], where: str) -> Any:
    numbers_of = np.asarray(factors)
    if numbers_of.dtype.kind not in "iuf" or numbers_of.ndim != 1:
        raise _core.InputError(
            f"{where}: expected an array with the factor of each vertex, or a list of dicts, got "
            f"an array of type {numbers_of.dtype} and shape {numbers_of.shape}"
        )
    if vertex_count is not None and numbers_of.size != vertex_count:
        raise _core.InputError(
            f"{where}: expected a factor for each of the {vertex_count} vertices, "
            f"got {numbers_of.size}"
        )
    if np.isnan(numbers_of).any():
        place = int(np.flatnonzero(np.isnan(numbers_of))[0])
        raise _core.InputError(f"{where}[{place}]: the number is not finite", [place])
    return {"field": ["rigid" if f == math.inf else f for f in numbers_of.tolist()]}


def landmarks_of(landmarks: Any, where: str) -> Array:
    """Converts a pair (vertex numbers, positions of shape (k, 3)) to the rows of targets."""
    if not isinstance(landmarks, (tuple, list)) or len(landmarks) != 2:
        raise _core.InputError(
            f"{where}: expected a pair (vertex numbers, positions), got {type(landmarks).__name__}"
        )
    ids = vertices_of(landmarks[0], f"{where}[0]")
    positions = np.asarray(landmarks[1])
    if positions.shape != (len(ids), 3) or positions.dtype.kind not in "iuf":
        raise _core.InputError(
            f"{where}[1]: expected positions of shape ({len(ids)}, 3), one for each vertex number, "
            f"got an array of type {positions.dtype} and shape {positions.shape}"
        )
    return np.column_stack([ids, positions])


def targets_and(landmarks: Any, targets: Any, name: str) -> Any:
    """Returns the targets of an operation called `name` that takes both."""
    if landmarks is None:
        return targets
    if targets is not None:
        raise _core.InputError(
            f"{name}: give landmarks or targets, not both; targets can have weights"
        )
    return landmarks_of(landmarks, f"{name}: landmarks")


def step_json(op: str, keys: Mapping[str, Any]) -> str:
    """Returns the JSON of a step. Keys that are None keep their defaults."""
    given = {key: value for key, value in keys.items() if value is not None}
    return json.dumps({"op": op, **given})
