# SPDX-License-Identifier: GPL-3.0-or-later
"""A grab: the user presses on the surface and pulls. The engine chooses the region.

A Gesture belongs to the main thread. It prepares and settles on background threads, and shows the
surface meanwhile. It does not depend on a window.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Generator, List, Optional, Sequence, Tuple

import bpy
import numpy as np
from mathutils import Vector

from . import live_mesh, recipe_store
from .arrays import MeshArrays, mesh_arrays, world_matrix
from .background import Job, Work
from .edit_request import check_object, mirror_plane
from .engine import Progress
from .errors import Refusal
from .live_mesh import rest_coordinates
from .regions import region_of
from .response import HandleFrame, Response, moved_handles
from .session import local_result
from .settings import settings_of

#: The fraction of the brush's radius within which the handle holds vertices with full weight.
_FULL_PART = 0.5
#: Even a smaller brush has a radius of this many mean edge lengths, so that it grabs a few
#: vertices.
_LEAST_EDGES = 2.0


@dataclass(frozen=True)
class GrabRequest:
    vertex: int
    radius: float  #: of the brush, along the surface in world units
    reach: float  #: factor that scales the region's radius
    matrix: np.ndarray
    rest: np.ndarray
    mesh: MeshArrays
    keys: Dict[str, Any]  #: further keys of the recipe's step


def picked(
    obj: bpy.types.Object, origin: Sequence[float], direction: Sequence[float]
) -> Optional[Tuple[int, np.ndarray]]:
    """Returns the vertex nearest to the point at which a world-space ray hits the surface, and
    this point."""
    inverse = obj.matrix_world.inverted_safe()
    along = (inverse.to_3x3() @ Vector(direction)).normalized()
    is_hit, place, _normal, _face = obj.ray_cast(inverse @ Vector(origin), along)
    if not is_hit:
        return None
    local = np.array(place, dtype=np.float32)
    distances = np.linalg.norm(rest_coordinates(obj) - local, axis=1)
    return int(np.argmin(distances)), np.array(obj.matrix_world @ place)


def gather(
    obj: bpy.types.Object, vertex: int, radius: float, reach: float
) -> Generator[None, None, GrabRequest]:
    """Reads the mesh in slices, with a yield after each slice. Returns the request."""
    check_object(obj)
    if settings_of(obj).is_live:
        raise Refusal(f"'{obj.name}' has a live edit; apply or cancel it before a grab")
    if not 0 <= vertex < len(obj.data.vertices):
        raise Refusal("The grab has no vertex; press on the surface of the active mesh")
    matrix = world_matrix(obj)
    rest = rest_coordinates(obj)
    yield
    mesh = mesh_arrays(obj.data, rest, matrix)
    yield
    keys: Dict[str, Any] = {"detail_length": settings_of(obj).detail_length}
    if obj.data.use_mirror_x:
        keys["mirror"] = mirror_plane(obj, matrix)
    radius = max(radius, _LEAST_EDGES * _mean_edge(mesh, vertex))
    return GrabRequest(vertex, radius, reach, matrix, rest, mesh, keys)


def _mean_edge(mesh: MeshArrays, vertex: int) -> float:
    """Returns the mean length of the edges at a vertex, 0 if it has none."""
    at = np.flatnonzero(mesh.corners == vertex)
    faces = np.searchsorted(mesh.starts, at, side="right") - 1
    ends = (mesh.starts + mesh.sizes)[faces]
    after = np.where(at + 1 == ends, mesh.starts[faces], at + 1)
    if len(after) == 0:
        return 0.0
    edges = mesh.vertices[mesh.corners[after]] - mesh.vertices[vertex]
    return float(np.linalg.norm(edges, axis=1).mean())


class PreparedGrab:
    """The engine's edit of a grab, and its linear response."""

    def __init__(self, engine: Any, request: GrabRequest, progress: Progress) -> None:
        self.request = request
        mesh, vertex = request.mesh, request.vertex
        region = engine.grab_region(mesh, vertex, request.radius, request.reach, progress)
        held = _FULL_PART * request.radius
        handle = {
            "region": {"disk": {"center": vertex, "radius": held}},
            "falloff": {"width": request.radius - held},
            "move": {},
        }
        self._step = {
            "op": "deform", "roi": region_of(region, len(mesh.vertices)), "handles": [handle],
            **request.keys,
        }
        frame = HandleFrame(mesh.vertices[vertex:vertex + 1], request.radius)
        columns, self._edit = engine.prepare(mesh, self._step, [frame], progress)
        self._response = Response(
            [frame], request.rest, mesh.vertices, columns, np.linalg.inv(request.matrix)
        )

    def coordinates(self, pull: np.ndarray) -> np.ndarray:
        """Returns the object-space coordinates for a world-space translation of the handle."""
        return self._response.coordinates([_shift(pull)])

    def settle(self, pull: np.ndarray, progress: Progress) -> Tuple[np.ndarray, List[str]]:
        """Returns the world coordinates (n, 3) and the warnings."""
        return self._edit.settle([_shift(pull)], [True], progress)

    def start_from(self, pull: np.ndarray, world: np.ndarray) -> None:
        """Makes the settled surface the pose from which `coordinates` continues."""
        self._response.set_pose([_shift(pull)], world)

    def step(self, pull: np.ndarray) -> Dict[str, Any]:
        """Returns the step of a recipe."""
        return {**self._step, "handles": moved_handles(self._step["handles"], [_shift(pull)], [True])}

    def close(self) -> None:
        self._edit.close()


def _shift(pull: np.ndarray) -> np.ndarray:
    motion = np.eye(4)
    motion[:3, 3] = pull
    return motion


def keep(
    obj: bpy.types.Object, prepared: PreparedGrab, pull: np.ndarray, world: np.ndarray
) -> None:
    """Writes the settled surface to the mesh, and the step to the object's recipe."""
    recipe_store.keep_original(obj)
    live_mesh.keep_in_mesh(obj, local_result(prepared.request, world))
    recipe_store.add(obj, [prepared.step(pull)], prepared.request.matrix)


class Gesture:
    """A grab from the press to the release."""

    def __init__(self, obj: bpy.types.Object, engine: Any, request: GrabRequest) -> None:
        self._name = obj.name
        self._engine = engine
        self._prepared: Optional[PreparedGrab] = None
        self._settled: Optional[Tuple[np.ndarray, np.ndarray]] = None  # pull and surface
        self.pull = np.zeros(3)
        self.warnings: List[str] = []
        self._is_released = False
        live_mesh.begin(obj)
        self.request = request
        self._job: Optional[Job] = Job(self._preparing())

    @property
    def obj(self) -> bpy.types.Object:
        return bpy.data.objects[self._name]

    def _preparing(self) -> Work:
        engine, request = self._engine, self.request
        return lambda progress: PreparedGrab(engine, request, progress)

    def resize(self, request: GrabRequest) -> None:
        """Continues the pull with another brush."""
        self._stop()
        self.request = request
        self._settled = None
        self._job = Job(self._preparing())

    def drag(self, pull: Sequence[float]) -> None:
        """Shows the surface for a translation of the handle in the world."""
        self.pull = np.array(pull, dtype=np.float64)
        self._show()

    def release(self) -> None:
        self._is_released = True

    @property
    def is_pulled(self) -> bool:
        return bool(self.pull.any())

    def advance(self) -> bool:
        """Takes the result of the background job and starts the next. Returns True once the surface
        of a released grab has settled. Raises the errors of the engine."""
        if self._job is not None:
            if not self._job.is_done:
                return False
            job, self._job = self._job, None
            self._take(job.result())
        assert self._prepared is not None
        if self._settled is not None and np.array_equal(self._settled[0], self.pull):
            return self._is_released
        if self.is_pulled:
            prepared, pull = self._prepared, self.pull
            self._job = Job(lambda progress: (pull, *prepared.settle(pull, progress)))
        return self._is_released and not self.is_pulled

    def _take(self, value: Any) -> None:
        if isinstance(value, PreparedGrab):
            self._prepared = value
        else:
            pull, world, self.warnings = value
            self._settled = (pull, world)
            self._prepared.start_from(pull, world)
        self._show()

    def _show(self) -> None:
        if self._prepared is not None:
            live_mesh.show(self.obj, self._prepared.coordinates(self.pull))

    def finish(self) -> None:
        """Keeps the settled surface."""
        prepared, (pull, world) = self._prepared, self._settled
        live_mesh.discard(self.obj)
        keep(self.obj, prepared, pull, world)
        self._stop()

    def cancel(self) -> None:
        """Restores the mesh."""
        self._stop()
        live_mesh.discard(self.obj)

    def _stop(self) -> None:
        prepared, self._prepared = self._prepared, None
        job, self._job = self._job, None
        if job is not None:
            job.cancelled = True
        if prepared is not None:
            if job is not None:
                job.wait()  # it settles this edit
            prepared.close()
