# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces over a range of frames: as shape keys, or as a point cache in a file."""

from __future__ import annotations

import os
import struct
from typing import Any, List, Sequence

import bpy
import numpy as np

from .arrays import set_coordinates
from .errors import Refusal

KEY_STEM = "Lapwing"


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
    modifier = obj.modifiers.get(KEY_STEM)
    if modifier is None or modifier.type != "MESH_CACHE":
        modifier = obj.modifiers.new(KEY_STEM, "MESH_CACHE")
    modifier.cache_format = kind
    modifier.filepath = path
    modifier.frame_start = first_frame
    # The cache replaces the mesh itself, so its modifier must be the first.
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
        key = obj.shape_key_add(name=f"{KEY_STEM} {frame}", from_mix=False)
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
    # Since 4.4 actions have layers; from 5.0 on, curves are only available through them.
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
    edit: Any, motions: Sequence[Any], free: Sequence[bool], progress: Any
) -> List[Any]:
    """Returns the world coordinates and warnings of each frame."""
    settled = []
    for k, of_frame in enumerate(motions):
        def heard(stage: str, _fraction: float, k: int = k) -> bool:
            return progress(f"frame {k + 1}, {stage}", k / len(motions))

        settled.append(edit.settle(of_frame, free, heard))
    return settled
