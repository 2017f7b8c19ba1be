# SPDX-License-Identifier: GPL-3.0-or-later
"""The exceptions of the add-on, and the mixin that reports them in Blender."""

from __future__ import annotations

from typing import Set

import bpy


class Refusal(Exception):
    """One sentence for Blender's report: what is wrong, and the next step."""


class Cancelled(Exception):
    """The user pressed Esc."""


class Refusing:
    """Mixin for an operator. Reports a Refusal of its method `act` in Blender."""

    def execute(self, context: bpy.types.Context) -> Set[str]:
        try:
            self.act(context)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        return {"FINISHED"}
