# SPDX-License-Identifier: GPL-3.0-or-later
"""The sidebar of the 3D view."""

from __future__ import annotations

from typing import Any

import bpy

from . import session
from .edit_request import edited_object, has_mesh
from .operators_wrap import report_lines
from .recipe_store import edits_of
from .settings import settings_of
from .wrapped_text import draw_text


class LAPWING_UL_handles(bpy.types.UIList):
    def draw_item(
        self, _context: Any, layout: Any, _data: Any, item: Any, _icon: Any, _active_data: Any,
        _active_property: Any,
    ) -> None:
        layout.prop(item, "name", text="", emboss=False, icon="EMPTY_AXIS")


class _Panel:
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Lapwing"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context)


class LAPWING_PT_edit(_Panel, bpy.types.Panel):
    bl_label = "Deform"

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return True

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        obj = edited_object(context)
        if obj is None:
            layout.label(text="Select a mesh object", icon="INFO")
            return
        settings = settings_of(obj)
        if session.has_session(obj):
            self._draw_live(context, session.session_of(obj))
            return
        if why := session.why_ended(obj):
            draw_text(layout, context, why, icon="ERROR")
        row = layout.row(align=True)
        row.operator("lapwing.grab", text="Grab", icon="VIEW_PAN")
        row.prop(context.window_manager, "lapwing_grab_pixels", text="Radius")
        column = layout.column()
        _draw_region(column, obj, settings, "roi", "Region")
        if context.mode in ("SCULPT", "OBJECT"):
            op = column.operator("lapwing.set_region", text="Region from Sculpt Mask", icon="MOD_MASK")
            op.role, op.source = "roi", "MASK"
        _draw_region(column, obj, settings, "belt", "Belt")
        if not settings.belt:
            column.prop(settings, "belt_fraction", text="Outer Share", slider=True)
        _draw_region(column, obj, settings, "pins", "Pins")
        column.prop_search(settings, "stiffness", obj, "vertex_groups", text="Stiffness")

        layout.label(text="Handles")
        row = layout.row()
        row.template_list("LAPWING_UL_handles", "", settings, "handles", settings, "active_handle", rows=2)
        buttons = row.column(align=True)
        buttons.operator("lapwing.add_handle", text="", icon="ADD")
        buttons.operator("lapwing.remove_handle", text="", icon="REMOVE")
        if settings.handles:
            handle = settings.handles[min(settings.active_handle, len(settings.handles) - 1)]
            column = layout.column()
            column.use_property_split = True
            column.use_property_decorate = False
            column.prop(handle, "empty")
            column.prop_search(handle, "group", obj, "vertex_groups", text="Vertices")
            column.prop(handle, "falloff")
            if handle.falloff > 0.0:
                column.prop(handle, "profile")
            column.prop(handle, "turns_freely")
        layout.operator("lapwing.set_rest")

        column = layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        column.prop(settings, "detail_length", text="Detail")
        column.prop(settings, "hard")
        column.prop(obj.data, "use_mirror_x", text="X Symmetry")

        row = layout.row()
        row.scale_y = 1.4
        row.operator("lapwing.start", icon="PLAY", text="Go On" if settings.is_live else "Start")
        if settings.is_live:
            layout.operator("lapwing.cancel", icon="X")

    def _draw_live(self, context: bpy.types.Context, live: session.Session) -> None:
        layout = self.layout
        layout.label(text="Live: move the Empties", icon="EMPTY_AXIS")
        layout.label(text="Settled" if live.is_settled else "Settling ...",
                     icon="CHECKMARK" if live.is_settled else "SORTTIME")
        for text in live.message.splitlines():
            draw_text(layout, context, text, icon="ERROR")
        column = layout.column(align=True)
        column.scale_y = 1.3
        column.operator("lapwing.apply", text="Apply to Mesh", icon="CHECKMARK").as_key = False
        column.operator("lapwing.apply", text="Apply as Shape Key", icon="SHAPEKEY_DATA").as_key = True
        column.operator("lapwing.cancel", icon="X")


def _draw_region(column: Any, obj: bpy.types.Object, settings: Any, role: str, label: str) -> None:
    row = column.row(align=True)
    row.prop_search(settings, role, obj, "vertex_groups", text=label)
    op = row.operator("lapwing.set_region", text="", icon="RESTRICT_SELECT_OFF")
    op.role, op.source = role, "SELECTION"


class LAPWING_PT_surfaces(_Panel, bpy.types.Panel):
    bl_label = "Detail and Parts"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        column.operator("lapwing.coat", icon="MOD_SKIN")
        column.operator("lapwing.mix", icon="MOD_TINT")
        column.operator("lapwing.transplant", icon="MOD_BOOLEAN")
        column.operator("lapwing.peel", icon="MOD_SMOOTH")
        draw_text(self.layout, context, "Source or part: select it, too", icon="INFO")


class LAPWING_PT_wrap(_Panel, bpy.types.Panel):
    bl_label = "Wrap and Transfer"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        draw_text(
            self.layout, context,
            "Select the scan, then the template. Landmarks: Empties with equal names, parented to "
            "both", icon="INFO",
        )
        column = self.layout.column(align=True)
        column.operator("lapwing.wrap", text="Wrap onto Scan", icon="MOD_SHRINKWRAP")
        column.operator(
            "lapwing.transfer_shape_keys", text="Transfer Shape Keys", icon="SHAPEKEY_DATA"
        )
        for line in report_lines(context.object):
            draw_text(self.layout, context, line, icon="DOT")


class LAPWING_PT_recipe(_Panel, bpy.types.Panel):
    bl_label = "Recipe and Bake"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        for k, edit in enumerate(edits_of(context.object)[-5:]):
            ops = ", ".join(step["op"] for step in edit["steps"])
            draw_text(layout, context, f"{ops} in {edit['key'] or 'the mesh'}", icon="DOT")
        column = layout.column(align=True)
        column.operator("lapwing.replay", text="Replay from Selected", icon="FILE_REFRESH")
        column.operator("lapwing.export_recipe", icon="EXPORT")
        column.operator("lapwing.forget_recipe", icon="TRASH")
        layout.operator("lapwing.bake", icon="RENDER_ANIMATION")


CLASSES = (
    LAPWING_UL_handles, LAPWING_PT_edit, LAPWING_PT_surfaces, LAPWING_PT_wrap, LAPWING_PT_recipe,
)
