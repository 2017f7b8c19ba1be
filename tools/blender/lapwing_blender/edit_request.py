# SPDX-License-Identifier: GPL-3.0-or-later
"""The edit from an object's settings, as a step of a recipe."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Sequence

import bpy
import numpy as np

from .arrays import MeshArrays, matrix_of, mesh_arrays, world_matrix
from .errors import Refusal
from .live_mesh import rest_coordinates
from .regions import group_index, read_groups, region_of
from .response import HandleFrame, moved_handles
from .settings import settings_of


@dataclass
class EditRequest:
    """A deform whose handles are at rest. Pins come after the handles of Empties."""

    object_name: str
    step: Dict[str, Any]
    matrix: np.ndarray  #: the object's world matrix when the request was made
    rest: np.ndarray  #: (n, 3) float32, rest positions in the object's local space
    mesh: MeshArrays
    frames: List[HandleFrame]
    turns_freely: List[bool]  #: per Empty, whether a pure translation leaves the orientation free

    @property
    def handle_count(self) -> int:
        return len(self.step["handles"])

    def motions(self, obj: bpy.types.Object) -> List[np.ndarray]:
        """Returns the motions of the handles by their Empties, in the world in which the edit was
        prepared. If the object has moved since, its handles have moved along."""
        to_prepared = self.matrix @ np.linalg.inv(matrix_of(obj.matrix_world))
        moved = []
        for handle in settings_of(obj).handles:
            rest = self.matrix @ matrix_of(handle.rest).reshape(4, 4)
            now = matrix_of(_empty_of(handle).matrix_world)
            moved.append(to_prepared @ now @ np.linalg.inv(rest))
        # Blender stores matrices in single precision. Replace the motions of handles at rest by the
        # identity, so that they do not change the mesh by rounding errors.
        return [
            np.eye(4) if frame.is_rest(motion) else motion
            for frame, motion in zip(self.frames, moved)
        ]

    def with_pins(self, motions: List[np.ndarray]) -> List[np.ndarray]:
        return motions + [np.eye(4)] * (self.handle_count - len(motions))

    def free_handles(self, frames: Sequence[Sequence[np.ndarray]]) -> List[bool]:
        """Returns which handles have a free orientation: those whose Empties only translate in all
        `frames` of motions. A pulled hand rotates by itself; a rotated one is held."""
        free = [
            may and all(frame.is_shift(motions[k]) for motions in frames)
            for k, (may, frame) in enumerate(zip(self.turns_freely, self.frames))
        ]
        return free + [False] * (self.handle_count - len(free))

    def moved_step(self, motions: List[np.ndarray]) -> Dict[str, Any]:
        """Returns the step of a recipe that makes this edit."""
        handles = moved_handles(
            self.step["handles"], self.with_pins(motions), self.free_handles([motions])
        )
        return {**self.step, "handles": handles}


def _empty_of(handle: Any) -> bpy.types.Object:
    if handle.empty is None:
        raise Refusal(
            f"The Empty of handle '{handle.name}' is gone; remove the handle or choose another"
        )
    return handle.empty


def check_object(obj: bpy.types.Object | None) -> bpy.types.Object:
    """Returns the object if it is a mesh that may be changed."""
    if obj is None or obj.type != "MESH":
        raise Refusal("The active object is no mesh; select the mesh to edit")
    for data in (obj, obj.data):
        if data.library is not None:
            raise Refusal(
                f"'{data.name}' is linked from another file; make it local first (Object > "
                "Relations > Make Local)"
            )
    return obj


def edited_object(context: bpy.types.Context) -> bpy.types.Object | None:
    """Returns the active object or, if that is the Empty of a handle, the handle's mesh."""
    obj = context.object
    if obj is None or obj.type == "MESH":
        return obj
    for other in context.view_layer.objects:
        if other.type == "MESH" and any(h.empty == obj for h in settings_of(other).handles):
            return other
    return obj


def has_mesh(context: bpy.types.Context) -> bool:
    return context.object is not None and context.object.type == "MESH"


def has_edited(context: bpy.types.Context) -> bool:
    obj = edited_object(context)
    return obj is not None and obj.type == "MESH"


def gather(obj: bpy.types.Object) -> Iterator[None]:
    """Yields while it reads. Its value is the EditRequest."""
    settings = settings_of(obj)
    matrix = world_matrix(obj)
    if len(settings.handles) == 0:
        raise Refusal("There is no handle; select vertices and add one")
    roi = group_index(obj, settings.roi, "The region")
    wanted = {"roi": roi}
    if settings.belt:
        wanted["belt"] = group_index(obj, settings.belt, "The belt")
    if settings.pins:
        wanted["pins"] = group_index(obj, settings.pins, "The pins")
    if settings.stiffness:
        wanted["stiffness"] = group_index(obj, settings.stiffness, "The stiffness")
    for k, handle in enumerate(settings.handles):
        _empty_of(handle)
        wanted[f"handle {k}"] = group_index(obj, handle.group, f"Handle '{handle.name}'")
    weights: Dict[int, np.ndarray] = {}
    for weights in read_groups(obj, list(wanted.values())):
        yield

    rest = rest_coordinates(obj)
    yield
    mesh = mesh_arrays(obj.data, rest, matrix)
    yield
    count = len(rest)
    held = {what: weights[index] for what, index in wanted.items()}
    in_roi = held["roi"] > 0.0
    if not in_roi.any():
        raise Refusal(
            f"The region is the vertex group '{settings.roi}', which is empty; assign vertices to "
            "it"
        )
    step: Dict[str, Any] = {
        "op": "deform",
        "roi": region_of(np.flatnonzero(in_roi), count),
        "belt": _belt(settings, held, in_roi),
        "handles": [],
        "detail_length": settings.detail_length,
        "hard": settings.hard,
    }
    size = np.linalg.norm(np.ptp(mesh.vertices[in_roi], axis=0)) or 1.0
    frames = []
    for k, handle in enumerate(settings.handles):
        of_handle = held[f"handle {k}"]
        step["handles"].append(_handle(handle, of_handle, in_roi))
        frames.append(HandleFrame(mesh.vertices[of_handle > 0.0], size))
    if "pins" in held and (pinned := np.flatnonzero((held["pins"] > 0.0) & in_roi)).size:
        step["handles"].append({"region": {"vertices": pinned.tolist()}, "move": {}})
    if "stiffness" in held:
        factors = _factors(held["stiffness"])
        step["stiffness"] = [{"region": {"all": True}, "factor": {"field": factors}}]
    if obj.data.use_mirror_x:
        step["mirror"] = mirror_plane(obj, matrix)
    # Handles with hard constraints cannot have a free orientation.
    free = [handle.turns_freely and not settings.hard for handle in settings.handles]
    return EditRequest(obj.name, step, matrix, rest, mesh, frames, free)


def _belt(settings: Any, held: Dict[str, np.ndarray], in_roi: np.ndarray) -> Dict[str, Any]:
    if "belt" not in held:
        return {"fraction": settings.belt_fraction}
    vertices = np.flatnonzero((held["belt"] > 0.0) & in_roi)
    if vertices.size == 0:
        raise Refusal(
            f"The belt is the vertex group '{settings.belt}', none of whose vertices is in the "
            "region; assign some, or clear the belt to take the outer part of the region"
        )
    return {"vertices": vertices.tolist()}


def _factors(weights: np.ndarray) -> List[Any]:
    """Returns the stiffness factors of painted weights. Weight 0 gives 0.01, weight 0.5 gives 1,
    weights just below 1 give almost 100, and weight 1 is rigid. Vertices outside the group, whose
    weight is -1, have the factor 1."""
    painted = np.clip(weights.astype(np.float64), 0.0, 1.0)
    factors = np.where(weights < 0.0, 1.0, np.clip(100.0 ** (2.0 * painted - 1.0), 0.01, 100.0))
    return ["rigid" if w >= 1.0 else f for w, f in zip(weights, factors.tolist())]


def _handle(handle: Any, weights: np.ndarray, in_roi: np.ndarray) -> Dict[str, Any]:
    vertices = np.flatnonzero(weights > 0.0)
    if vertices.size == 0:
        raise Refusal(
            f"Handle '{handle.name}' is the vertex group '{handle.group}', which is empty; assign "
            "vertices to it"
        )
    outside = vertices[~in_roi[vertices]]
    if outside.size:
        raise Refusal(
            f"Handle '{handle.name}' leaves the region at vertex {outside[0]}; enlarge the region, "
            "or take such vertices out of the handle"
        )
    written: Dict[str, Any] = {"region": {"vertices": vertices.tolist()}, "move": {}}
    if weights.max() >= 1.0 and (weights[vertices] < 1.0).any():
        if handle.falloff > 0.0:
            raise Refusal(
                f"Handle '{handle.name}' has both painted weights and a falloff; set the falloff to "
                "0, or the weights to 1"
            )
        written["weight"] = {"field": np.clip(weights, 0.0, 1.0).tolist()}
    elif handle.falloff > 0.0:
        written["falloff"] = {"width": handle.falloff, "profile": handle.profile}
    return written


def mirror_plane(obj: bpy.types.Object, matrix: np.ndarray) -> Dict[str, Any]:
    """Returns the object's plane x = 0 in the world."""
    linear = matrix[:3, :3]
    normal = np.linalg.inv(linear)[0]
    normal /= np.linalg.norm(normal)
    along = linear[:, 0] / np.linalg.norm(linear[:, 0])
    if abs(normal @ along) < 1.0 - 1e-6:
        raise Refusal(
            f"'{obj.name}' is sheared, so that its X symmetry is none in the world; apply its "
            "scale (Ctrl A)"
        )
    return {"point": matrix[:3, 3].tolist(), "normal": normal.tolist()}


def return_handles(obj: bpy.types.Object) -> None:
    """Moves the Empties back to rest, except those with keyframes or drivers."""
    from mathutils import Matrix

    for handle in settings_of(obj).handles:
        if handle.empty is not None and handle.empty.animation_data is None:
            rest = Matrix(matrix_of(handle.rest).reshape(4, 4).tolist())
            handle.empty.matrix_world = obj.matrix_world @ rest
