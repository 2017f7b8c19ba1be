# SPDX-License-Identifier: GPL-3.0-or-later
"""Code shared by operators."""

from __future__ import annotations

from typing import Set

import bpy

from .edit_request import edited_object
from .errors import Refusal


class Refusing:
    """Mixin that reports a Refusal of `act` in Blender."""

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
