# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes keyframed Empties over a range of frames: as shape keys, or as a point cache in a file."""

import os
import struct
from typing import Any, Generator, List, Sequence, Set

import bpy
import numpy as np
from bpy.props import EnumProperty, IntProperty, StringProperty

from . import session
from .arrays import set_coordinates
from .background import EngineOperator, Work, warn
from .edit_request import check_object, gather, has_mesh
from .engine import Progress
from .errors import Refusal
from .preferences import chosen_engine
from .settings import settings_of

_MOST_KEYS = 1000
_KEY_STEM = "Lapwing"


def write_pc2(path: str, first_frame: int, surfaces: Sequence[np.ndarray]) -> None:
    """Writes a PC2 cache: little-endian, as in 3ds Max and the Mesh Cache modifier."""
    header = struct.pack(
        "<12siiffi", b"POINTCACHE2\0", 1, len(surfaces[0]), float(first_frame), 1.0, len(surfaces)
    )
    _write(path, [header, *(surface.astype("<f4").tobytes() for surface in surfaces)])


def write_mdd(path: str, frames_per_second: float, surfaces: Sequence[np.ndarray]) -> None:
    """Writes an MDD cache: big-endian, as LightWave writes it."""
    header = struct.pack(">ii", len(surfaces), len(surfaces[0]))
    times = (np.arange(len(surfaces)) / frames_per_second).astype(">f4").tobytes()
    _write(path, [header, times, *(surface.astype(">f4").tobytes() for surface in surfaces)])


def _write(path: str, parts: List[bytes]) -> None:
    try:
        with open(path, "wb") as file:
            file.writelines(parts)
    except OSError as error:
        raise Refusal(
            f"{path} cannot be written ({error.strerror}); choose another folder"
        ) from error


def add_cache_modifier(obj: bpy.types.Object, path: str, kind: str, first_frame: int) -> None:
    modifier = obj.modifiers.get(_KEY_STEM)
    if modifier is None or modifier.type != "MESH_CACHE":
        modifier = obj.modifiers.new(_KEY_STEM, "MESH_CACHE")
    modifier.cache_format = kind
    modifier.filepath = path
    modifier.frame_start = first_frame
    # The cache replaces the coordinates of the mesh, so its modifier must be the first one.
    index = obj.modifiers.find(modifier.name)
    if index > 0:
        with bpy.context.temp_override(object=obj):
            bpy.ops.object.modifier_move_to_index(modifier=modifier.name, index=0)


def add_frame_keys(obj: bpy.types.Object, first_frame: int, surfaces: Sequence[np.ndarray]) -> None:
    """Adds a shape key for each frame, with the value 1 at that frame and 0 one frame away."""
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis", from_mix=False)
    for k, surface in enumerate(surfaces):
        frame = first_frame + k
        key = obj.shape_key_add(name=f"{_KEY_STEM} {frame}", from_mix=False)
        set_coordinates(key.data, surface)
        for at, value in ((frame - 1, 0.0), (frame, 1.0), (frame + 1, 0.0)):
            key.value = value
            key.keyframe_insert("value", frame=at)
    for curve in _curves(obj.data.shape_keys.animation_data.action):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def _curves(action: bpy.types.Action) -> List[bpy.types.FCurve]:
    if hasattr(action, "fcurves"):
        return list(action.fcurves)
    # Actions have layers since Blender 4.4. From 5.0 on, curves are available only through layers.
    return [
        curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
        for curve in bag.fcurves
    ]


def cache_path(given: str, obj: bpy.types.Object, kind: str) -> str:
    """Returns the path of the cache, by default beside the .blend file."""
    extension = "." + kind.lower()
    if given:
        path = bpy.path.abspath(given)
        return path if path.lower().endswith(extension) else path + extension
    if not bpy.data.filepath:
        raise Refusal("The cache has no place yet; choose a file for it, or save the .blend first")
    return os.path.join(
        os.path.dirname(bpy.data.filepath), bpy.path.clean_name(obj.name) + extension
    )


def settle_all(
    edit: Any, motions: Sequence[Any], free: Sequence[bool], progress: Progress
) -> List[Any]:
    """Returns the world coordinates and warnings of each frame."""
    settled = []
    for k, of_frame in enumerate(motions):
        def heard(stage: str, _fraction: float, k: int = k) -> bool:
            return progress(f"frame {k + 1}, {stage}", k / len(motions))

        settled.append(edit.settle(of_frame, free, heard))
    return settled


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
        self._path = "" if self.kind == "KEYS" else cache_path(self.cache_file, obj, self.kind)
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
                return settle_all(edit, motions, request.free_handles(motions), progress)
            finally:
                edit.close()

        return work

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        obj = bpy.data.objects[self._name]
        surfaces = [session.local_result(self._request, world) for world, _ in value]
        if self.kind == "KEYS":
            add_frame_keys(obj, self.first, surfaces)
        else:
            if self.kind == "PC2":
                write_pc2(self._path, self.first, surfaces)
            else:
                render = context.scene.render
                write_mdd(self._path, render.fps / render.fps_base, surfaces)
            add_cache_modifier(obj, self._path, self.kind, self.first)
        warnings = [
            f"frame {self.first + k}: {text[0]}" for k, (_, text) in enumerate(value) if text
        ]
        warn(self, warnings[:3])


CLASSES = (LAPWING_OT_bake,)
