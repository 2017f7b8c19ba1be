# SPDX-License-Identifier: GPL-3.0-or-later
"""Transfers the shape keys of another mesh to the active mesh."""

from __future__ import annotations

from typing import Any, Dict, Generator, List, Tuple

import bpy
import numpy as np
from bpy.props import BoolProperty, StringProperty

from .arrays import coordinates_of, object_arrays, rest_points, set_coordinates, to_local
from .arrays import transformed, world_matrix
from .background import EngineOperator, Work, warn
from .edit_request import check_object, has_mesh
from .errors import Refusal
from .operators_surface import other_object
from .operators_wrap import Landmarks
from .preferences import chosen_engine
from .settings import settings_of


def poses_of(obj: bpy.types.Object) -> Dict[str, np.ndarray]:
    """Returns the vertices of `obj` in the world for each shape key at the value 1."""
    keys = obj.data.shape_keys
    if keys is None or len(keys.key_blocks) < 2:
        raise Refusal(f"'{obj.name}' has no shape keys besides its basis; add some, or select the "
                      "mesh that has them")
    rest = coordinates_of(rest_points(obj.data))
    matrix = world_matrix(obj)
    return {
        key.name: transformed(
            matrix, rest + coordinates_of(key.data) - coordinates_of(key.relative_key.data)
        )
        for key in keys.key_blocks if key != keys.reference_key
    }


class LAPWING_OT_transfer_shape_keys(EngineOperator, bpy.types.Operator):
    bl_idname = "lapwing.transfer_shape_keys"
    bl_label = "Lapwing Transfer Shape Keys"
    bl_description = (
        "Transfers the shape keys of the other selected mesh to the active mesh, which may have "
        "other faces. Empties with equal names, one parented to each mesh, are landmarks"
    )
    bl_options = {"REGISTER", "UNDO"}

    source: StringProperty(name="Source", description="Without it, the other selected mesh")
    aligned: BoolProperty(name="Aligned", description="Both meshes are in the same place")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and not settings_of(context.object).is_live

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "source")
        layout.prop(self, "aligned")

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(context.object)
        engine = chosen_engine(context)
        source = other_object(context, self.source, "The source")
        if obj.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        self._name, self._matrix = obj.name, world_matrix(obj)
        poses = poses_of(source)
        self._keys = list(poses)
        self._landmarks = Landmarks(obj, source)
        yield
        target, at_rest = object_arrays(obj), object_arrays(source)
        rows, aligned = self._landmarks.rows, self.aligned
        return lambda progress: engine.transfer(
            at_rest, list(poses.values()), target, rows, aligned, progress
        )

    def finish(self, _context: bpy.types.Context, value: Tuple[List[np.ndarray], Any]) -> None:
        obj = bpy.data.objects[self._name]
        posed, warnings = value
        if obj.data.shape_keys is None:
            obj.shape_key_add(name="Basis", from_mix=False)
        for name, vertices in zip(self._keys, posed):
            key = obj.data.shape_keys.key_blocks.get(name)
            if key is None:
                key = obj.shape_key_add(name=name, from_mix=False)
            set_coordinates(key.data, to_local(self._matrix, vertices))
        obj.data.update()
        warn(self, [*warnings, *self._landmarks.notes])


CLASSES = (LAPWING_OT_transfer_shape_keys,)
