# SPDX-License-Identifier: GPL-3.0-or-later
"""Region, handles, and the live edit from its start to where its result goes."""

from __future__ import annotations

from typing import Any, Generator, Set

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from . import live_mesh, recipe_store, session
from .arrays import coordinates_of, matrix_of, rest_points, transformed, world_matrix
from .background import EngineOperator, Work, warn
from .edit_request import check_object, edited_object, gather, put_handle_at_rest, return_handles
from .errors import Refusal
from .preferences import chosen_engine
from .regions import free_name, masked_vertices, selected_vertices, set_group
from .settings import PROFILES, settings_of

_ROLES = [
    ("roi", "Region", "What may move"),
    ("belt", "Belt", "What stays"),
    ("pins", "Pins", "What stays where it is, also inside the region"),
]
_GROUPS = {"roi": "Lapwing Region", "belt": "Lapwing Belt", "pins": "Lapwing Pins"}


class Refusing:
    """Mixin: what `act` refuses is reported in Blender's way."""

    def execute(self, context: bpy.types.Context) -> Set[str]:
        try:
            self.act(context)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        return {"FINISHED"}


def has_mesh(context: bpy.types.Context) -> bool:
    return context.object is not None and context.object.type == "MESH"


def has_edited(context: bpy.types.Context) -> bool:
    obj = edited_object(context)
    return obj is not None and obj.type == "MESH"


class LAPWING_OT_set_region(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.set_region"
    bl_label = "Set Region"
    bl_description = "Makes a vertex group of the selection or the sculpt mask, for the region, belt or pins"
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
        setattr(settings_of(obj), self.role, _grouped(context, obj, _GROUPS[self.role], vertices))


def _grouped(context: bpy.types.Context, obj: bpy.types.Object, name: str, vertices: np.ndarray) -> str:
    """A vertex group of that name; edit mode keeps groups elsewhere and is left for a moment."""
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
        handle.group = _grouped(context, obj, name, vertices)
        handle.falloff, handle.profile = self.falloff, self.profile
        put_handle_at_rest(obj, handle)
        settings_of(obj).active_handle = len(settings_of(obj).handles) - 1


    def _take_proportional_editing(self, context: bpy.types.Context) -> None:
        """Where it is on, it says how far a move reaches."""
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
                put_handle_at_rest(obj, handle)


class LAPWING_OT_start(EngineOperator, bpy.types.Operator):
    bl_idname = "lapwing.start"
    bl_label = "Start Edit"
    bl_description = "Prepares the edit; from then on the surface follows the handles"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_edited(context)

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(edited_object(context))
        engine = chosen_engine(context)
        if obj.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        request = yield from gather(obj)
        self._name = obj.name
        return session.preparing(engine, request)

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        session.start(bpy.data.objects[self._name], value)


class LAPWING_OT_respond(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.respond"
    bl_label = "Respond"
    bl_description = "Shows the linear response to where the handles are, as a script needs it that has no window"
    bl_options = {"INTERNAL"}

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(edited_object(context))
        session.session_of(obj).respond(obj)


class _Settling(EngineOperator):
    """Mixin: settles what is not settled yet before `settled` goes on."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_edited(context) and session.has_session(edited_object(context))

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(edited_object(context))
        self._name = obj.name
        live = session.session_of(obj)
        live.respond(obj)
        if live.is_settled:
            return lambda _progress: None
        return live.settling(live.motions())
        yield  # a generator, as it has to be, that needs no pause

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        obj = bpy.data.objects[self._name]
        live = session.session_of(obj)
        if value is not None:
            live.take(obj, value)
            warn(self, value[2])
        self.settled(context, obj, live)

    def settled(self, context: bpy.types.Context, obj: bpy.types.Object, live: session.Session) -> None:
        pass


class LAPWING_OT_settle(_Settling, bpy.types.Operator):
    bl_idname = "lapwing.settle"
    bl_label = "Settle"
    bl_description = "Minimizes the energy for where the handles are"
    bl_options = {"REGISTER", "UNDO"}


class LAPWING_OT_apply(_Settling, bpy.types.Operator):
    bl_idname = "lapwing.apply"
    bl_label = "Apply Edit"
    bl_description = "Ends the live edit and keeps its settled surface"
    bl_options = {"REGISTER", "UNDO"}

    as_key: BoolProperty(name="As Shape Key", description="In a shape key, with the mesh as it was")
    key_name: StringProperty(name="Name", default="Lapwing")

    def settled(self, context: bpy.types.Context, obj: bpy.types.Object, live: session.Session) -> None:
        coordinates = live.coordinates().copy()
        key = ""
        if self.as_key:
            key = live_mesh.keep_as_key(obj, coordinates, self.key_name or "Lapwing")
            return_handles(obj)
        else:
            # The original has to be the mesh at rest.
            live_mesh.discard(obj)
            recipe_store.keep_original(obj)
            live_mesh.keep_in_mesh(obj, coordinates)
            for handle in settings_of(obj).handles:
                put_handle_at_rest(obj, handle)
        step = live.request.moved_step(live.motions())
        recipe_store.add(obj, [step], live.request.matrix, key=key)
        settings_of(obj).is_live = False
        session.stop(obj.name)


class LAPWING_OT_cancel(Refusing, bpy.types.Operator):
    bl_idname = "lapwing.cancel"
    bl_label = "Cancel Edit"
    bl_description = "Ends the live edit; the surface and the handles are as before it"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_edited(context) and settings_of(edited_object(context)).is_live

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(edited_object(context))
        session.stop(obj.name)
        live_mesh.discard(obj)
        return_handles(obj)
        settings_of(obj).is_live = False


CLASSES = (
    LAPWING_OT_set_region, LAPWING_OT_add_handle, LAPWING_OT_remove_handle, LAPWING_OT_set_rest,
    LAPWING_OT_start, LAPWING_OT_respond, LAPWING_OT_settle, LAPWING_OT_apply, LAPWING_OT_cancel,
)
