# SPDX-License-Identifier: GPL-3.0-or-later
"""Text in as many lines as the region's width needs: Blender clips a label that is longer."""

from __future__ import annotations

from typing import Any, Callable, List

import blf
import bpy

#: Width of the panel's borders, the scroll bar and an icon, in points. The text uses the rest.
_TAKEN_POINTS = 60.0


def wrapped(text: str, width: float, width_of: Callable[[str], float]) -> List[str]:
    """Returns the lines of `text`, none wider than `width` unless a single letter is. A word that
    is too wide, such as a path, continues on the next line."""
    lines: List[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if width_of(longer) <= width:
            line = longer
            continue
        if line:
            lines.append(line)
        while len(word) > 1 and width_of(word) > width:
            fitting = max((k for k in range(1, len(word)) if width_of(word[:k]) <= width), default=1)
            lines.append(word[:fitting])
            word = word[fitting:]
        line = word
    return [*lines, line] if line else lines


def draw_text(layout: Any, context: bpy.types.Context, text: str, icon: str = "NONE") -> None:
    """Draws `text` wrapped to the width of the region, with the icon at its first line."""
    preferences = context.preferences
    scale = preferences.system.ui_scale
    blf.size(0, preferences.ui_styles[0].widget.points * scale)
    width = context.region.width - _TAKEN_POINTS * scale
    column = layout.column(align=True)
    column.scale_y = 0.8
    for line in wrapped(text, width, lambda part: blf.dimensions(0, part)[0]):
        column.label(text=line, icon=icon)
        icon = "BLANK1" if icon != "NONE" else icon
