# SPDX-License-Identifier: GPL-3.0-or-later
"""Stores the surface of a live edit, and its rest shape.

In a mesh without shape keys, the surface is written to the mesh, which is the fastest way, and an
attribute keeps the rest shape. In a mesh with shape keys, Blender shows only these. There the
surface is written to an additional key, and the first key is the rest shape. Both survive saving
and undo.
"""

from __future__ import annotations

import bpy
import numpy as np

from .arrays import coordinates_of, set_coordinates

REST = "lapwing_rest"
LIVE_KEY = "Lapwing Live"


def rest_coordinates(obj: bpy.types.Object) -> np.ndarray:
    mesh = obj.data
    if mesh.shape_keys is not None:
        return coordinates_of(mesh.shape_keys.reference_key.data)
    attribute = mesh.attributes.get(REST)
    if attribute is None:
        return coordinates_of(mesh.vertices)
    flat = np.empty(3 * len(mesh.vertices), np.float32)
    attribute.data.foreach_get("vector", flat)
    return flat.reshape(-1, 3)


def begin(obj: bpy.types.Object) -> None:
    mesh = obj.data
    if mesh.shape_keys is not None:
        if LIVE_KEY not in mesh.shape_keys.key_blocks:
            obj.shape_key_add(name=LIVE_KEY, from_mix=False).value = 1.0
    elif mesh.attributes.get(REST) is None:
        rest = coordinates_of(mesh.vertices)
        mesh.attributes.new(REST, "FLOAT_VECTOR", "POINT").data.foreach_set("vector", rest.ravel())


def is_begun(obj: bpy.types.Object) -> bool:
    """Returns whether the data of `begin` still exists. Shape keys that were added since would hide
    it."""
    mesh = obj.data
    if mesh.shape_keys is not None:
        return LIVE_KEY in mesh.shape_keys.key_blocks
    return mesh.attributes.get(REST) is not None


def show(obj: bpy.types.Object, coordinates: np.ndarray) -> None:
    mesh = obj.data
    if mesh.shape_keys is None:
        set_coordinates(mesh.vertices, coordinates)
        mesh.update()
        return
    key = mesh.shape_keys.key_blocks.get(LIVE_KEY)
    if key is not None:
        set_coordinates(key.data, coordinates)
    mesh.update_tag()


def discard(obj: bpy.types.Object) -> None:
    """Restores the rest shape."""
    mesh = obj.data
    if mesh.shape_keys is None:
        set_coordinates(mesh.vertices, rest_coordinates(obj))
    _forget(obj)
    mesh.update()


def keep_in_mesh(obj: bpy.types.Object, coordinates: np.ndarray) -> None:
    """Applies the surface to the mesh. Shape keys keep their offsets from the rest shape."""
    mesh = obj.data
    change = coordinates - rest_coordinates(obj)
    _forget(obj)
    if mesh.shape_keys is not None:
        for key in mesh.shape_keys.key_blocks:
            set_coordinates(key.data, coordinates_of(key.data) + change)
    set_coordinates(mesh.vertices, coordinates)
    mesh.update()


def keep_as_key(obj: bpy.types.Object, coordinates: np.ndarray, name: str) -> str:
    """Stores the surface as a shape key. Returns the key's name."""
    discard(obj)
    if obj.data.shape_keys is None:
        obj.shape_key_add(name="Basis", from_mix=False)
    key = obj.shape_key_add(name=name, from_mix=False)
    set_coordinates(key.data, coordinates)
    key.value = 1.0
    obj.active_shape_key_index = len(obj.data.shape_keys.key_blocks) - 1
    obj.data.update()
    return key.name


def _forget(obj: bpy.types.Object) -> None:
    mesh = obj.data
    attribute = mesh.attributes.get(REST)
    if attribute is not None:
        mesh.attributes.remove(attribute)
    if mesh.shape_keys is not None:
        key = mesh.shape_keys.key_blocks.get(LIVE_KEY)
        if key is not None:
            obj.shape_key_remove(key)
