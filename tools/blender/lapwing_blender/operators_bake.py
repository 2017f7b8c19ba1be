# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes keyframed Empties over a range of frames."""

from typing import Any, Generator, List, Set

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from . import bake, session
from .background import EngineOperator, Work, warn
from .edit_request import check_object, gather
from .engine import Progress
from .errors import Refusal
from .operator_parts import has_mesh
from .preferences import chosen_engine
from .settings import settings_of

_MOST_KEYS = 1000


class LAPWING_OT_bake(EngineOperator, bpy.types.Operator):
    bl_idname = "lapwing.bake"
    bl_label = "Bake"
    bl_description = (
        "Settles the surface at each frame of a range, for handles whose Empties are keyframed"
    )
    bl_options = {"REGISTER", "UNDO"}

    first: IntProperty(name="First Frame", default=1)
    last: IntProperty(name="Last Frame", default=24)
    kind: EnumProperty(
        items=[
            ("KEYS", "Shape Keys", "A shape key for each frame"),
            ("PC2", "PC2 Cache", "A point cache in a file, shown by a Mesh Cache modifier"),
            ("MDD", "MDD Cache", "A point cache in a file, shown by a Mesh Cache modifier"),
        ],
        name="As",
    )
    cache_file: StringProperty(
        name="File", subtype="FILE_PATH", description="Beside the .blend file without it",
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_mesh(context) and not settings_of(context.object).is_live

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> Set[str]:
        if not self.properties.is_property_set("first"):
            self.first, self.last = context.scene.frame_start, context.scene.frame_end
        return super().invoke(context, event)

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(context.object)
        engine = chosen_engine(context)
        if self.last < self.first:
            raise Refusal(
                f"The last frame, {self.last}, is before the first, {self.first}; exchange them"
            )
        if self.kind == "KEYS" and self.last - self.first >= _MOST_KEYS:
            raise Refusal(
                f"Shape keys of more than {_MOST_KEYS} frames take too much memory; bake a PC2 or "
                "MDD cache"
            )
        self._path = "" if self.kind == "KEYS" else bake.cache_path(self.cache_file, obj, self.kind)
        if obj.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        self._name = obj.name
        request = yield from gather(obj)
        self._request = request
        scene, now = context.scene, context.scene.frame_current
        motions: List[Any] = []
        try:
            for frame in range(self.first, self.last + 1):
                scene.frame_set(frame)
                motions.append(request.with_pins(request.motions(obj)))
                yield
        finally:
            scene.frame_set(now)

        def work(progress: Progress) -> Any:
            _, edit = engine.prepare(request.mesh, request.step, [], progress)
            try:
                return bake.settle_all(edit, motions, request.free_handles(motions), progress)
            finally:
                edit.close()

        return work

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        obj = bpy.data.objects[self._name]
        surfaces = [session.local_result(self._request, world) for world, _ in value]
        if self.kind == "KEYS":
            bake.add_frame_keys(obj, self.first, surfaces)
        else:
            if self.kind == "PC2":
                bake.write_pc2(self._path, self.first, surfaces)
            else:
                render = context.scene.render
                bake.write_mdd(self._path, render.fps / render.fps_base, surfaces)
            bake.add_cache_modifier(obj, self._path, self.kind, self.first)
        warnings = [
            f"frame {self.first + k}: {text[0]}" for k, (_, text) in enumerate(value) if text
        ]
        warn(self, warnings[:3])


CLASSES = (LAPWING_OT_bake,)
