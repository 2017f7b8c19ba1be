# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads regions: vertex groups, the selection, the sculpt mask, the 3D cursor."""

from __future__ import annotations

from typing import Any, Dict, Generator, Iterator, List, Sequence

import bpy
import numpy as np

from .errors import Refusal

#: A generator that yields while it reads. It returns a region of a recipe.
Region = Generator[None, None, Dict[str, Any]]
#: Number of vertices whose groups are read in one slice, which takes a few milliseconds.
_SLICE = 2_000
#: Vertices with at least this value of the sculpt mask belong to the region.
_MASKED = 0.5


def group_index(obj: bpy.types.Object, name: str, what: str) -> int:
    if not name:
        raise Refusal(
            f"{what} is not set; choose a vertex group for it, or set it from the selection"
        )
    group = obj.vertex_groups.get(name)
    if group is None:
        raise Refusal(
            f"{what} is the vertex group '{name}', which '{obj.name}' does not have; choose another"
        )
    return group.index


def read_groups(obj: bpy.types.Object, indices: Sequence[int]) -> Iterator[Dict[int, np.ndarray]]:
    """Reads the weight of each vertex in each of these groups, -1 for none. Blender provides the
    groups vertex by vertex, which takes a second for some million vertices. Yields between slices;
    only the last value is complete."""
    vertices = obj.data.vertices
    weights = {index: np.full(len(vertices), -1.0, np.float32) for index in set(indices)}
    for begin in range(0, len(vertices) if weights else 0, _SLICE):
        for v, vertex in enumerate(vertices[begin:begin + _SLICE], begin):
            for element in vertex.groups:
                if element.group in weights:
                    weights[element.group][v] = element.weight
        yield weights
    yield weights


def selected_vertices(obj: bpy.types.Object) -> np.ndarray:
    """Returns the selection of edit mode, or the last one."""
    obj.update_from_editmode()
    chosen = np.empty(len(obj.data.vertices), bool)
    obj.data.vertices.foreach_get("select", chosen)
    return np.flatnonzero(chosen)


def masked_vertices(obj: bpy.types.Object) -> np.ndarray:
    mesh = obj.data
    values = np.zeros(len(mesh.vertices), np.float32)
    # In newer versions of Blender, the mask is an attribute; in older ones, a separate layer.
    attribute = mesh.attributes.get(".sculpt_mask")
    if attribute is not None:
        attribute.data.foreach_get("value", values)
    elif getattr(mesh, "vertex_paint_masks", None):
        mesh.vertex_paint_masks[0].data.foreach_get("value", values)
    return np.flatnonzero(values >= _MASKED)


def set_group(obj: bpy.types.Object, name: str, vertices: np.ndarray) -> str:
    """Creates or replaces the vertex group of this name, with only these vertices."""
    group = obj.vertex_groups.get(name)
    if group is not None:
        obj.vertex_groups.remove(group)
    group = obj.vertex_groups.new(name=name)
    group.add(vertices.tolist(), 1.0, "REPLACE")
    return group.name


def region_of(vertices: np.ndarray, count: int) -> Dict[str, Any]:
    """Returns a region of a recipe."""
    if len(vertices) == count:
        return {"all": True}
    return {"vertices": vertices.tolist()}


def named_region(obj: bpy.types.Object, name: str, what: str) -> Region:
    """Yields while it reads. Its value is the vertices with weights above 0 in a group."""
    index = group_index(obj, name, what)
    weights: Dict[int, np.ndarray] = {}
    for weights in read_groups(obj, [index]):
        yield
    vertices = np.flatnonzero(weights[index] > 0.0)
    if len(vertices) == 0:
        raise Refusal(f"{what} is the vertex group '{name}', which is empty; assign vertices to it")
    return region_of(vertices, len(obj.data.vertices))


def cursor_region(cursor: Sequence[float], radius: float) -> Dict[str, Any]:
    """Returns the region within a distance of the 3D cursor along the surface."""
    return {"disk": {"near": [float(x) for x in cursor], "radius": radius}}


def chosen_region(
    context: bpy.types.Context, obj: bpy.types.Object, source: str, radius: float, group: str,
    what: str,
) -> Region:
    """Yields while it reads. Its value is the region for an item of the operators' `REGIONS`."""
    if source == "ALL":
        return {"all": True}
    if source == "CURSOR":
        return cursor_region(context.scene.cursor.location, radius)
    if source == "GROUP":
        return (yield from named_region(obj, group, what))
    vertices = selected_vertices(obj)
    if len(vertices) == 0:
        raise Refusal(
            f"{what} is the selection of '{obj.name}', which is empty; select faces of it"
        )
    return region_of(vertices, len(obj.data.vertices))


def free_name(obj: bpy.types.Object, stem: str) -> str:
    names: List[str] = [group.name for group in obj.vertex_groups]
    number = 1
    while f"{stem} {number}" in names:
        number += 1
    return f"{stem} {number}"
