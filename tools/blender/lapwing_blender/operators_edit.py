# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators of the live edit, from its start to its result."""

from typing import Any, Generator

import bpy
from bpy.props import BoolProperty, StringProperty

from . import live_mesh, recipe_store, session
from .background import EngineOperator, Work, warn
from .edit_request import check_object, edited_object, gather, has_edited, return_handles
from .errors import Refusing
from .preferences import chosen_engine
from .settings import put_at_rest, settings_of


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
    bl_description = (
        "Shows the linear response to where the handles are, as a script needs it that has no "
        "window"
    )
    bl_options = {"INTERNAL"}

    def act(self, context: bpy.types.Context) -> None:
        obj = check_object(edited_object(context))
        session.session_of(obj).respond(obj)


class _Settling(EngineOperator):
    """Mixin that settles the surface, if necessary, before it calls `settled`."""

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
        yield  # never reached; makes this function a generator

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        obj = bpy.data.objects[self._name]
        live = session.session_of(obj)
        if value is not None:
            live.take(obj, value)
            warn(self, value[2])
        self.settled(obj, live)

    def settled(self, obj: bpy.types.Object, live: session.Session) -> None:
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

    def settled(self, obj: bpy.types.Object, live: session.Session) -> None:
        coordinates = live.coordinates().copy()
        key = ""
        if self.as_key:
            key = live_mesh.keep_as_key(obj, coordinates, self.key_name or "Lapwing")
            return_handles(obj)
        else:
            # Restore the rest shape first, because `keep_original` copies the mesh.
            live_mesh.discard(obj)
            recipe_store.keep_original(obj)
            live_mesh.keep_in_mesh(obj, coordinates)
            for handle in settings_of(obj).handles:
                put_at_rest(obj, handle)
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
    LAPWING_OT_start, LAPWING_OT_respond, LAPWING_OT_settle, LAPWING_OT_apply, LAPWING_OT_cancel,
)
