# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of an object's edit. Blender saves them with the file and includes them in undo."""

import bpy
import numpy as np
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    FloatVectorProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from .arrays import matrix_of

PROFILES = [
    ("smooth", "Smooth", "The hold of the handle fades out smoothly"),
    ("linear", "Linear", "The hold of the handle fades out linearly"),
]


def _is_empty(_self: bpy.types.PropertyGroup, obj: bpy.types.Object) -> bool:
    return obj.type == "EMPTY"


def put_at_rest(obj: bpy.types.Object, handle: "LapwingHandle") -> None:
    """Makes the Empty's current place its rest."""
    seen = np.linalg.inv(matrix_of(obj.matrix_world)) @ matrix_of(handle.empty.matrix_world)
    handle.rest = seen.ravel().tolist()


def _another_empty(handle: "LapwingHandle", _context: bpy.types.Context) -> None:
    if handle.empty is not None:
        put_at_rest(handle.id_data, handle)


class LapwingHandle(bpy.types.PropertyGroup):
    """Vertices that follow an Empty. `name` is Blender's own key of a collection."""

    empty: PointerProperty(
        type=bpy.types.Object, poll=_is_empty, update=_another_empty, name="Empty",
        description="Moves the handle, from where it is when it is chosen",
    )
    group: StringProperty(
        name="Vertex Group",
        description="The handle's vertices; weights between 0 and 1 hold them by that much",
    )
    rest: FloatVectorProperty(
        size=16, name="Rest", description="Where the Empty is at rest, seen from the object",
    )
    falloff: FloatProperty(
        name="Falloff", min=0.0, subtype="DISTANCE",
        description="Over this distance beyond its vertices the handle's hold fades out",
    )
    profile: EnumProperty(items=PROFILES, name="Profile")
    turns_freely: BoolProperty(
        name="Turns Freely", default=True,
        description="While the Empty is only moved, the handle turns as the surface wants; an Empty "
        "that is turned or scaled holds it",
    )


class LapwingSettings(bpy.types.PropertyGroup):
    roi: StringProperty(
        name="Region", description="The vertex group that may move; nothing outside it does",
    )
    belt: StringProperty(
        name="Belt", description="The vertex group that stays; without one, the outer part of the region",
    )
    belt_fraction: FloatProperty(
        name="Belt", min=0.001, max=0.9, default=0.1,
        description="The outer share of the region that stays",
    )
    pins: StringProperty(
        name="Pins", description="A vertex group that stays where it is, also inside the region",
    )
    stiffness: StringProperty(
        name="Stiffness",
        description="The vertex group whose weights define the stiffness: 1 is rigid, 0.5 is as stiff as "
        "usual, and 0 is soft. Vertices outside the group are as stiff as usual",
    )
    handles: CollectionProperty(type=LapwingHandle)
    active_handle: IntProperty()
    detail_length: FloatProperty(
        name="Detail Length", min=1e-6, max=1000.0, default=0.077, precision=3,
        description="Details smaller than this share of the region's radius keep their shape",
    )
    hard: BoolProperty(
        name="Hold Exactly", description="Belt and handles reach their places to the last digit, and no handle turns freely",
    )
    is_live: BoolProperty(name="Live", description="The surface follows the handles", options={"HIDDEN"})
    #: A copy of the mesh before its first edit. Recipes start from this mesh.
    original: PointerProperty(type=bpy.types.Mesh, options={"HIDDEN"})


def settings_of(obj: bpy.types.Object) -> LapwingSettings:
    return obj.lapwing


CLASSES = (LapwingHandle, LapwingSettings)


def register() -> None:
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Object.lapwing = PointerProperty(type=LapwingSettings)


def unregister() -> None:
    del bpy.types.Object.lapwing
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
