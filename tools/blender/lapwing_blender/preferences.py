# SPDX-License-Identifier: GPL-3.0-or-later
"""Preferences: the path of the engine, if Python or the system cannot find it."""

from typing import Any

import bpy
from bpy.props import StringProperty

from . import engine
from .errors import Refusal
from .wrapped_text import draw_text


def _changed(_self: Any, _context: bpy.types.Context) -> None:
    engine.forget()


class LapwingPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    engine_path: StringProperty(
        name="Engine", subtype="FILE_PATH", update=_changed,
        description="The folder that holds the Python module 'lapwing', or the program 'lapwing'. "
        "Without it, the module that Python finds, or else the program on PATH",
    )

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(self, "engine_path")
        found = engine.last_look(self.engine_path)
        if isinstance(found, Refusal):
            draw_text(self.layout, context, str(found), icon="ERROR")
        else:
            version = ".".join(map(str, found.version))
            draw_text(self.layout, context, f"Found: {found.name}, version {version}", icon="CHECKMARK")
        self.layout.operator("lapwing.find_engine", text="Look Again", icon="FILE_REFRESH")


def chosen_engine(context: bpy.types.Context) -> Any:
    """Returns the engine, or raises Refusal."""
    addon = context.preferences.addons.get(__package__)
    return engine.engine(addon.preferences.engine_path if addon is not None else "")


class LAPWING_OT_find_engine(bpy.types.Operator):
    bl_idname = "lapwing.find_engine"
    bl_label = "Look for the Engine"
    bl_description = "Looks for the engine again"

    def execute(self, context: bpy.types.Context) -> set:
        engine.forget()
        try:
            chosen_engine(context)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        return {"FINISHED"}


CLASSES = (LapwingPreferences, LAPWING_OT_find_engine)
