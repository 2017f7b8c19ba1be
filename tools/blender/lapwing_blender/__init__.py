# SPDX-License-Identifier: GPL-3.0-or-later
"""Lapwing in Blender: edits surface meshes and keeps their detail."""

bl_info = {
    "name": "Lapwing",
    "description": "Deform, coat, mix and transplant surfaces, and keep their detail",
    "author": "The Lapwing authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Lapwing",
    "category": "Mesh",
}

import bpy

from . import (
    operators_bake,
    operators_edit,
    operators_grab,
    operators_recipe,
    operators_region,
    operators_surface,
    operators_transfer,
    operators_wrap,
    panel,
    preferences,
    session,
    settings,
)

_CLASSES = (
    *preferences.CLASSES, *operators_region.CLASSES, *operators_edit.CLASSES,
    *operators_grab.CLASSES, *operators_surface.CLASSES, *operators_wrap.CLASSES,
    *operators_transfer.CLASSES, *operators_recipe.CLASSES, *operators_bake.CLASSES,
    *panel.CLASSES,
)


def register() -> None:
    settings.register()
    for each in _CLASSES:
        bpy.utils.register_class(each)
    operators_grab.register()
    session.register()


def unregister() -> None:
    session.unregister()
    operators_grab.unregister()
    for each in reversed(_CLASSES):
        bpy.utils.unregister_class(each)
    settings.unregister()
