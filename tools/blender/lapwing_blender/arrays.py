# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's meshes as arrays, and back. No loop over vertices or faces runs in Python here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from .errors import Refusal


@dataclass(frozen=True)
class MeshArrays:
    """A polygon mesh in world units, oriented outward as the world sees it."""

    vertices: np.ndarray  #: (n, 3) float64
    corners: np.ndarray  #: uint32, the vertices of all polygons, concatenated
    sizes: np.ndarray  #: int32, the number of corners of each polygon
    materials: np.ndarray  #: int32, the material slot of each polygon

    @property
    def starts(self) -> np.ndarray:
        return np.cumsum(self.sizes) - self.sizes

    def has_faces_of(self, other: "MeshArrays") -> bool:
        return (
            len(self.vertices) == len(other.vertices)
            and np.array_equal(self.sizes, other.sizes)
            and np.array_equal(self.corners, other.corners)
        )

    def turned_over(self) -> "MeshArrays":
        """Returns the mesh with the orientation of every polygon reversed."""
        ends = np.repeat(self.starts + self.sizes - 1, self.sizes)
        within = np.arange(len(self.corners)) - np.repeat(self.starts, self.sizes)
        return MeshArrays(self.vertices, self.corners[ends - within], self.sizes, self.materials)


def coordinates_of(points: Any) -> np.ndarray:
    """Returns the coordinates (n, 3), float32, of mesh vertices or of a shape key's points."""
    flat = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def set_coordinates(points: Any, coordinates: np.ndarray) -> None:
    points.foreach_set("co", np.ascontiguousarray(coordinates, np.float32).ravel())


def matrix_of(matrix: Any) -> np.ndarray:
    return np.array(matrix, dtype=np.float64)


def transformed(matrix: np.ndarray, points: np.ndarray) -> np.ndarray:
    return points.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]


def world_matrix(obj: bpy.types.Object) -> np.ndarray:
    """Returns the world matrix; refuses a singular one."""
    matrix = matrix_of(obj.matrix_world)
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    volume = abs(np.linalg.det(matrix[:3, :3]))
    if not np.isfinite(matrix).all() or volume <= 1e-12 * lengths.prod():
        raise Refusal(f"'{obj.name}' is scaled to nothing along an axis; give it a scale above 0")
    return matrix


def is_mirrored(matrix: np.ndarray) -> bool:
    return bool(np.linalg.det(matrix[:3, :3]) < 0)


def rest_points(mesh: bpy.types.Mesh) -> Any:
    """Returns the points that store the surface without shape keys."""
    return mesh.shape_keys.reference_key.data if mesh.shape_keys else mesh.vertices


def mesh_arrays(mesh: bpy.types.Mesh, local: np.ndarray, matrix: np.ndarray) -> MeshArrays:
    """Returns the faces of `mesh` on the coordinates `local`, transformed by `matrix`."""
    if len(mesh.polygons) == 0:
        raise Refusal(f"The mesh '{mesh.name}' has no faces; choose one that has")
    corners = np.empty(len(mesh.loops), np.uint32)  # Blender's type, so no conversion is needed
    mesh.loops.foreach_get("vertex_index", corners)
    sizes = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    materials = np.zeros(len(mesh.polygons), np.int32)
    attribute = mesh.attributes.get("material_index")  # the fastest way to read material slots
    if attribute is not None:
        attribute.data.foreach_get("value", materials)
    arrays = MeshArrays(transformed(matrix, local), corners, sizes, materials)
    return arrays.turned_over() if is_mirrored(matrix) else arrays


def object_arrays(obj: bpy.types.Object) -> MeshArrays:
    """Returns an object's mesh at rest: without modifiers, on its first shape key."""
    obj.update_from_editmode()
    mesh = obj.data
    return mesh_arrays(mesh, coordinates_of(rest_points(mesh)), world_matrix(obj))


def to_local(matrix: np.ndarray, world: np.ndarray) -> np.ndarray:
    """Returns float32 coordinates in the object whose world matrix is `matrix`."""
    return transformed(np.linalg.inv(matrix), world).astype(np.float32)


def similarity_scale(matrix: np.ndarray) -> float:
    """Returns the scale factor of a matrix for lengths, averaged over all directions."""
    return float(np.cbrt(abs(np.linalg.det(matrix[:3, :3]))))
