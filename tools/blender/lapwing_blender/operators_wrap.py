# SPDX-License-Identifier: GPL-3.0-or-later
"""Wrap: deforms the active mesh, a template, so that it covers another mesh, a scan."""

from __future__ import annotations

import json
import re
from typing import Any, Dict, List

import bpy
from bpy.props import BoolProperty, StringProperty

from .arrays import world_matrix
from .background import warn
from .edit_request import mirror_plane
from .engine import Outcome
from .errors import Refusal
from .operators_surface import Step, SurfaceOperator, other_object
from .settings import settings_of

#: The custom property with the report of the last wrap, as JSON.
PROPERTY = "lapwing_wrap"

#: Blender appends this to a name that exists already.
_SUFFIX = re.compile(r"\.\d{3,}$")


def landmarks_of(obj: bpy.types.Object) -> Dict[str, bpy.types.Object]:
    """Returns the Empties whose parent is `obj`, by name without Blender's ".001". The Empties of
    handles are not landmarks."""
    handles = {handle.empty for handle in settings_of(obj).handles}
    found: Dict[str, bpy.types.Object] = {}
    for child in obj.children:
        if child.type != "EMPTY" or child in handles:
            continue
        name = _SUFFIX.sub("", child.name)
        if name in found:
            raise Refusal(
                f"The Empties '{found[name].name}' and '{child.name}' of '{obj.name}' have the "
                "same name; give each landmark its own name"
            )
        found[name] = child
    return found


class Landmarks:
    """The Empties of a template and of a scan that have the same name."""

    def __init__(self, template: bpy.types.Object, scan: bpy.types.Object) -> None:
        ours, theirs = landmarks_of(template), landmarks_of(scan)
        names = [name for name in ours if name in theirs]
        self.pairs = [(ours[name].name, theirs[name].name) for name in names]
        #: The landmarks in world coordinates, as in a recipe.
        self.rows = [
            {"label": ours[name].name, "point": list(ours[name].matrix_world.translation),
             "position": list(theirs[name].matrix_world.translation)}
            for name in names
        ]
        self.notes = [
            f"The Empty '{left[name].name}' has no effect: '{other.name}' has no Empty of this name"
            for left, right, other in ((ours, theirs, scan), (theirs, ours, template))
            for name in left if name not in right
        ]


def report_lines(obj: bpy.types.Object) -> List[str]:
    """Returns the report of the last wrap of `obj` for the panel."""
    report = json.loads(obj.get(PROPERTY, "{}"))
    if not report:
        return []
    size = report["scan_diagonal"] or 1.0
    lines = [
        f"{words}: {distance['mean'] / size:.2%} on average, {distance['max'] / size:.2%} at most"
        for words, distance in (
            ("Result to scan", report["to_scan"]), ("Scan to result", report["to_template"])
        )
    ]
    lines.append(f"Covered by the scan: {report['coverage']:.1%}")
    if report["landmark_error"] > 0.0:
        lines.append(f"Landmarks: off by at most {report['landmark_error'] / size:.2%}")
    return [*lines, f"Flipped triangles: {report['flipped_triangles']}"]


class LAPWING_OT_wrap(SurfaceOperator, bpy.types.Operator):
    bl_idname = "lapwing.wrap"
    bl_label = "Lapwing Wrap"
    bl_description = (
        "Deforms the active mesh so that it covers the other selected mesh, a scan. Empties with "
        "equal names, one parented to each mesh, are landmarks. X Symmetry keeps the mesh symmetric"
    )
    bl_options = {"REGISTER", "UNDO"}

    scan: StringProperty(name="Scan", description="Without it, the other selected mesh")
    aligned: BoolProperty(name="Aligned", description="The active mesh is already in place")
    hard: BoolProperty(name="Hard Landmarks", description="Reach the landmarks exactly")
    detail: BoolProperty(
        name="Detail", description="Move vertices exactly onto the scan at the end"
    )
    shown = ("scan", "aligned", "hard", "detail")

    def draw(self, _context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        for name in self.shown:
            layout.prop(self, name)

    def step(self, context: bpy.types.Context, obj: bpy.types.Object) -> Step:
        scan = other_object(context, self.scan, "The scan")
        self._landmarks = Landmarks(obj, scan)
        step: Dict[str, Any] = {"op": "wrap", "scan": "scan.ply", "aligned": self.aligned,
                                "hard": self.hard, "detail": self.detail}
        if obj.data.use_mirror_x:
            step["mirror"] = mirror_plane(obj, world_matrix(obj))
        if self._landmarks.rows:
            step["landmarks"] = self._landmarks.rows
        yield
        return step, {"scan.ply": scan.name}

    def finish(self, context: bpy.types.Context, value: Outcome) -> None:
        super().finish(context, value)
        obj = bpy.data.objects[self._name]
        obj[PROPERTY] = json.dumps(value.steps[-1]["wrap"])
        # Keep the Empties of the template on its surface, so that it can be wrapped again.
        for ours, theirs in self._landmarks.pairs:
            place = bpy.data.objects[theirs].matrix_world.translation
            bpy.data.objects[ours].matrix_world.translation = place
        warn(self, self._landmarks.notes)


CLASSES = (LAPWING_OT_wrap,)
