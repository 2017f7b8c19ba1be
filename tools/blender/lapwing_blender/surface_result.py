# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the engine's results into an object: only positions if the faces are the same."""

from __future__ import annotations

from typing import List

import bpy
import numpy as np

from . import live_mesh
from .arrays import MeshArrays, coordinates_of, is_mirrored, rest_points, to_local
from .errors import Refusal

_REBUILT = "the result has other faces than before"


def put(obj: bpy.types.Object, before: MeshArrays, made: MeshArrays, matrix: np.ndarray) -> List[str]:
    """Replaces the mesh of `obj`, which was `before` in the world of `matrix`. Returns notes on
    what could not be kept."""
    if made.has_faces_of(before):
        local = to_local(matrix, made.vertices)
        still = (made.vertices == before.vertices).all(axis=1)
        local[still] = coordinates_of(rest_points(obj.data))[still]
        live_mesh.keep_in_mesh(obj, local)
        return []
    if obj.data.shape_keys is not None:
        raise Refusal(f"'{obj.name}' has shape keys, and {_REBUILT}; remove the keys first")
    if any(modifier.type == "MULTIRES" for modifier in obj.modifiers):
        raise Refusal(
            f"'{obj.name}' has a Multires modifier, and {_REBUILT}; apply the modifier first"
        )
    return _rebuild(obj, made.turned_over() if is_mirrored(matrix) else made, matrix)


def _rebuild(obj: bpy.types.Object, made: MeshArrays, matrix: np.ndarray) -> List[str]:
    mesh = obj.data
    donor = _donor(obj)
    smooth = np.empty(len(mesh.polygons), bool)
    mesh.polygons.foreach_get("use_smooth", smooth)
    is_smooth = bool(smooth.mean() > 0.5)

    mesh.clear_geometry()  # also removes the names of the vertex groups
    mesh.vertices.add(len(made.vertices))
    mesh.vertices.foreach_set("co", to_local(matrix, made.vertices).ravel())
    mesh.loops.add(len(made.corners))
    mesh.loops.foreach_set("vertex_index", made.corners.astype(np.uint32))
    mesh.polygons.add(len(made.sizes))
    mesh.polygons.foreach_set("loop_start", made.starts.astype(np.int32))
    # In newer versions of Blender, `loop_total` is computed from `loop_start`.
    if not bpy.types.MeshPolygon.bl_rna.properties["loop_total"].is_readonly:
        mesh.polygons.foreach_set("loop_total", made.sizes)
    last_slot = max(len(mesh.materials) - 1, 0)
    mesh.polygons.foreach_set("material_index", np.clip(made.materials, 0, last_slot).astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(len(made.sizes), is_smooth))
    mesh.update(calc_edges=True)
    mesh.validate()
    for group in donor.vertex_groups:
        if group.name not in obj.vertex_groups:
            obj.vertex_groups.new(name=group.name)
    return _bring_layers(obj, donor)


def _donor(obj: bpy.types.Object) -> bpy.types.Object:
    """Returns a copy of the object without modifiers, to take weights and UV maps from."""
    donor = bpy.data.objects.new(f"{obj.name} before", obj.data.copy())
    donor.matrix_world = obj.matrix_world
    for group in obj.vertex_groups:
        if group.name not in donor.vertex_groups:
            donor.vertex_groups.new(name=group.name)
    bpy.context.scene.collection.objects.link(donor)
    return donor


def _bring_layers(obj: bpy.types.Object, donor: bpy.types.Object) -> List[str]:
    """Copies weights and UV maps with Blender's Data Transfer, from the nearest place."""
    kinds = []
    if len(donor.vertex_groups):
        kinds.append(("VGROUP_WEIGHTS", {"vert_mapping": "POLYINTERP_NEAREST"}))
    if len(donor.data.uv_layers):
        kinds.append(("UV", {"loop_mapping": "POLYINTERP_NEAREST"}))
    failed = []
    bpy.context.view_layer.update()
    try:
        for kind, mapping in kinds:
            with bpy.context.temp_override(
                object=donor, active_object=donor, selected_objects=[donor, obj],
                selected_editable_objects=[donor, obj],
            ):
                done = bpy.ops.object.data_transfer(
                    data_type=kind, use_create=True, layers_select_src="ALL",
                    layers_select_dst="NAME", **mapping,
                )
            if done != {"FINISHED"}:
                failed.append("the vertex groups" if kind == "VGROUP_WEIGHTS" else "the UV maps")
    finally:
        mesh = donor.data
        bpy.data.objects.remove(donor)
        bpy.data.meshes.remove(mesh)
    return [f"{' and '.join(failed)} could not be kept, since {_REBUILT}"] if failed else []
