# SPDX-License-Identifier: GPL-3.0-or-later
"""Stores the edits of an object as recipes, for replaying elsewhere or for `lapwing run`."""

from __future__ import annotations

import json
from functools import lru_cache
from typing import Any, Callable, Dict, Generator, List, Mapping, Sequence, Tuple

import bpy
import numpy as np

from .arrays import MeshArrays, coordinates_of, matrix_of, mesh_arrays, object_arrays, rest_points
from .arrays import similarity_scale, transformed
from .errors import Refusal
from .settings import settings_of

#: The name of the custom property, a JSON list of edits. `add` appends to this list.
PROPERTY = "lapwing_edits"


def edits_of(obj: bpy.types.Object) -> List[Dict[str, Any]]:
    """Returns the edits, which must not be changed."""
    return list(_read(obj.get(PROPERTY, "[]")))


@lru_cache(maxsize=4)
def _read(text: str) -> List[Dict[str, Any]]:
    """Caches the parsed edits: a panel needs them at every redraw, and regions may be large."""
    return json.loads(text)


def add(
    obj: bpy.types.Object, steps: Sequence[Mapping[str, Any]], matrix: np.ndarray, key: str = "",
    objects: Mapping[str, str] | None = None,
) -> None:
    """Stores an edit of the mesh or, if `key` is not empty, of that shape key. `matrix` was the
    object's world matrix. `objects` maps the files in the steps to names of mesh objects."""
    edits = edits_of(obj)
    edits.append({
        "steps": list(steps), "matrix": matrix.ravel().tolist(), "key": key,
        "objects": dict(objects or {}),
    })
    obj[PROPERTY] = json.dumps(edits)


def keeping_original(obj: bpy.types.Object, put: Callable[[], Any]) -> Any:
    """Calls `put`, which writes into the mesh or refuses, and returns its value."""
    had = settings_of(obj).original is not None
    keep_original(obj)
    try:
        return put()
    except Refusal:
        if not had:
            forget_original(obj)
        raise


def keep_original(obj: bpy.types.Object) -> None:
    """Copies the mesh before its first edit."""
    settings = settings_of(obj)
    if settings.original is None:
        settings.original = obj.data.copy()
        settings.original.name = f"{obj.data.name} before Lapwing"


def forget_original(obj: bpy.types.Object) -> None:
    settings = settings_of(obj)
    original, settings.original = settings.original, None
    if original is not None and original.users == 0:
        bpy.data.meshes.remove(original)


def forget(obj: bpy.types.Object) -> None:
    forget_original(obj)
    if PROPERTY in obj:
        del obj[PROPERTY]


def chain(obj: bpy.types.Object, last: int = -1) -> List[Dict[str, Any]]:
    """Returns the edits that lead to edit `last`: earlier edits of the mesh itself, and `last`."""
    edits = edits_of(obj)
    if not edits:
        raise Refusal(f"'{obj.name}' has no recipe; make an edit on it first")
    last = last % len(edits)
    return [edit for edit in edits[:last] if not edit["key"]] + [edits[last]]


def start_mesh(obj: bpy.types.Object, matrix: np.ndarray) -> MeshArrays:
    """Returns the mesh at the start of the chain, transformed by `matrix`."""
    mesh = settings_of(obj).original or obj.data
    return mesh_arrays(mesh, coordinates_of(rest_points(mesh)), matrix)


def steps_at(
    edits: List[Dict[str, Any]], matrix: np.ndarray
) -> Tuple[List[Dict[str, Any]], Dict[str, str]]:
    """Returns the steps for an object at `matrix`, and the objects of the files that they name."""
    steps: List[Dict[str, Any]] = []
    objects: Dict[str, str] = {}
    for edit in edits:
        by = np.eye(4)
        if not np.array_equal(matrix_of_edit(edit), matrix):
            by = matrix @ np.linalg.inv(matrix_of_edit(edit))
        # All edits use the same file names, so rename the files.
        files: Dict[str, str] = {}
        for file, name in edit["objects"].items():
            same = [known for known, other in objects.items() if other == name]
            files[file] = same[0] if same else f"{len(objects)}-{file}"
            objects[files[file]] = name
        steps += [with_files(moved_step(step, by), files) for step in edit["steps"]]
    return steps, objects


#: Keys whose values are mesh files.
_FILES = ("source", "mesh", "scan")


def with_files(value: Any, names: Mapping[str, str]) -> Any:
    """Returns a step with renamed files."""
    if isinstance(value, Mapping):
        return {
            key: names.get(each, each) if key in _FILES and isinstance(each, str)
            else with_files(each, names)
            for key, each in value.items()
        }
    if isinstance(value, list) and value and isinstance(value[0], Mapping):
        return [with_files(each, names) for each in value]
    return value


def other_meshes(objects: Mapping[str, str]) -> Generator[None, None, Dict[str, MeshArrays]]:
    """Yields while it reads. Its value is the current meshes of the objects that a recipe names."""
    meshes = {}
    for file, name in objects.items():
        other = bpy.data.objects.get(name)
        if other is None or other.type != "MESH":
            raise Refusal(
                f"The recipe needs the mesh object '{name}', which is gone; bring it back under "
                "this name"
            )
        meshes[file] = object_arrays(other)
        yield
    return meshes


def moved_step(step: Mapping[str, Any], by: np.ndarray) -> Dict[str, Any]:
    """Returns a step for a mesh moved by a matrix. Lengths on other meshes do not change."""
    if np.array_equal(by, np.eye(4)):
        return dict(step)
    if step["op"] == "transplant" and "matrix" in step.get("place", {}):
        moved = _moved({k: v for k, v in step.items() if k != "place"}, by)
        place = by @ np.array(step["place"]["matrix"]).reshape(4, 4)
        return {**moved, "place": {"matrix": place.ravel().tolist()}}
    moved = _moved(step, by)
    if step["op"] == "peel":
        moved["detail_size"] *= similarity_scale(by)  # here a length on the edited mesh
    return moved


#: Keys that refer to the source of the detail. The source does not move with the edited mesh.
_OF_SOURCES = {"source_patch", "part"}
_LENGTHS = {"radius", "width", "padding", "smooth_target"}


def _moved(value: Any, by: np.ndarray, key: str = "") -> Any:
    if key in _OF_SOURCES:
        return value
    if key == "sources":
        return [each if "mesh" in each else _of_the_mesh_itself(each, by) for each in value]
    if isinstance(value, Mapping):
        return {name: _moved(each, by, name) for name, each in value.items()}
    if key == "matrix":
        return (by @ np.array(value).reshape(4, 4) @ np.linalg.inv(by)).ravel().tolist()
    if key in ("near", "point"):
        return transformed(by, np.array([value]))[0].tolist()
    if key == "normal":
        normal = np.array(value) @ np.linalg.inv(by[:3, :3])
        return (normal / np.linalg.norm(normal)).tolist()
    if key in _LENGTHS and not isinstance(value, (list, dict)):
        return value * similarity_scale(by)
    if isinstance(value, list) and value and isinstance(value[0], Mapping):
        return [_moved(each, by) for each in value]
    return value


def _of_the_mesh_itself(source: Mapping[str, Any], by: np.ndarray) -> Dict[str, Any]:
    """Moves a source of a mix that is the edited mesh itself."""
    return {**_moved(source, by), "detail_size": source["detail_size"] * similarity_scale(by)}


def matrix_of_edit(edit: Mapping[str, Any]) -> np.ndarray:
    return matrix_of(edit["matrix"]).reshape(4, 4)
