# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators for region, belt, pins and handles."""

import bpy
import numpy as np
from bpy.props import EnumProperty, FloatProperty

from .arrays import coordinates_of, rest_points, transformed, world_matrix
from .edit_request import check_object, edited_object, has_edited, has_mesh
from .errors import Refusal, Refusing
from .regions import free_name, masked_vertices, selected_vertices, set_group
from .settings import PROFILES, put_at_rest, settings_of

_ROLES = [
    ("roi", "Region", "What may move"),
    ("belt", "Belt", "What stays"),
    ("pins", "Pins", "What stays where it is, also inside the region"),
]
_GROUPS = {"roi": "Lapwing Region", "belt": "Lapwing Belt", "pins": "Lapwing Pins"}


class LAPWING_OT_set_region(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.set_region"
    bl_label = "Set Region"
    bl_description = (
        "Makes a vertex group of the selection or the sculpt mask, for the region, belt or pins"
    )
    bl_options = {"REGISTER", "UNDO"}

    role: EnumProperty(items=_ROLES, name="Role")
    source: EnumProperty(
        items=[
            ("SELECTION", "Selection", "The selected vertices"),
            ("MASK", "Sculpt Mask", "What is masked by at least a half"),
        ],
        name="From",
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context)

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(context.object)
        masked = self.source == "MASK"
        vertices = masked_vertices(obj) if masked else selected_vertices(obj)
        if len(vertices) == 0:
            raise Refusal("Nothing is masked; paint a mask in Sculpt Mode" if masked
                          else "Nothing is selected; select vertices in Edit Mode")
        setattr(settings_of(obj), self.role, _grouped(obj, _GROUPS[self.role], vertices))


def _grouped(obj: bpy.types.Object, name: str, vertices: np.ndarray) -> str:
    """Creates a vertex group of that name. Leaves edit mode for a moment, since edit mode stores
    groups elsewhere."""
    mode = obj.mode
    if mode == "EDIT":
        bpy.ops.object.mode_set(mode="OBJECT")
    made = set_group(obj, name, vertices)
    if mode == "EDIT":
        bpy.ops.object.mode_set(mode="EDIT")
    return made


class LAPWING_OT_add_handle(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.add_handle"
    bl_label = "Add Handle"
    bl_description = "Makes a handle of the selected vertices, and an Empty that moves it"
    bl_options = {"REGISTER", "UNDO"}

    falloff: FloatProperty(
        name="Falloff", min=0.0, subtype="DISTANCE",
        description="Over this distance beyond its vertices the handle's hold fades out",
    )
    profile: EnumProperty(items=PROFILES, name="Profile")
    size: FloatProperty(
        name="Empty's Size", min=0.0, subtype="DISTANCE", description="0 takes that of the handle",
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context)

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(context.object)
        vertices = selected_vertices(obj)
        if len(vertices) == 0:
            raise Refusal("Nothing is selected; select the handle's vertices in Edit Mode")
        if not self.properties.is_property_set("falloff"):
            self._take_proportional_editing(context)
        matrix = world_matrix(obj)
        points = transformed(matrix, coordinates_of(rest_points(obj.data))[vertices])
        name = free_name(obj, "Handle")
        empty = bpy.data.objects.new(f"{obj.name} {name}", None)
        empty.empty_display_type = "SPHERE"
        extent = float(np.linalg.norm(np.ptp(points, axis=0))) / 2.0
        empty.empty_display_size = self.size or extent or 0.1
        empty.show_in_front = True
        empty.location = points.mean(axis=0)
        for collection in obj.users_collection[:1] or [context.scene.collection]:
            collection.objects.link(empty)
        context.view_layer.update()
        handle = settings_of(obj).handles.add()
        handle.name = name
        handle.empty = empty
        handle.group = _grouped(obj, name, vertices)
        handle.falloff, handle.profile = self.falloff, self.profile
        settings_of(obj).active_handle = len(settings_of(obj).handles) - 1


    def _take_proportional_editing(self, context: bpy.types.Context) -> None:
        """Takes the falloff from proportional editing if that is on."""
        tools = context.tool_settings
        editing = context.mode == "EDIT_MESH"
        if tools.use_proportional_edit if editing else tools.use_proportional_edit_objects:
            self.falloff = tools.proportional_size
            self.profile = "linear" if tools.proportional_edit_falloff == "LINEAR" else "smooth"


class LAPWING_OT_remove_handle(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.remove_handle"
    bl_label = "Remove Handle"
    bl_description = "Removes the handle chosen in the list, with its Empty and vertex group"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and len(settings_of(context.object).handles) > 0

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(context.object)
        settings = settings_of(obj)
        if settings.is_live:
            raise Refusal("The edit is live; finish or cancel it before its handles change")
        chosen = min(settings.active_handle, len(settings.handles) - 1)
        handle = settings.handles[chosen]
        group = obj.vertex_groups.get(handle.group)
        if handle.empty is not None:
            bpy.data.objects.remove(handle.empty)
        if group is not None:
            obj.vertex_groups.remove(group)
        settings.handles.remove(chosen)
        settings.active_handle = max(0, chosen - 1)


class LAPWING_OT_set_rest(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.set_rest"
    bl_label = "Set Rest"
    bl_description = "Where the Empties are now is where the handles rest"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_edited(context) and len(settings_of(edited_object(context)).handles) > 0

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(edited_object(context))
        for handle in settings_of(obj).handles:
            if handle.empty is not None:
                put_at_rest(obj, handle)


CLASSES = (
    LAPWING_OT_set_region, LAPWING_OT_add_handle, LAPWING_OT_remove_handle, LAPWING_OT_set_rest,
)
