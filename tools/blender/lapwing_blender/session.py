# SPDX-License-Identifier: GPL-3.0-or-later
"""Live edits: the surface follows the Empties by the linear response, and settles on a thread.

The surface is a function of the Empties' places, so that Blender's undo, which restores these, also
restores the surface. Sessions end with the file. Objects are found by name, since undo creates new
ones.
"""

from __future__ import annotations

from typing import Any, Dict, List, Optional

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import live_mesh
from .arrays import to_local
from .background import Job, Work
from .edit_request import EditRequest
from .engine import Progress
from .errors import Cancelled, Refusal
from .response import PARAMETERS, Response
from .settings import settings_of

#: Interval between two checks of the Empties.
_TICK_SECONDS = 1.0 / 60.0

_sessions: Dict[str, "Session"] = {}
#: For each object whose live edit ended without a user's action, the reason. The panel shows it.
_ends: Dict[str, str] = {}


class Session:
    def __init__(self, request: EditRequest, response: Response, edit: Any) -> None:
        self.request = request
        self.response = response
        self.edit = edit
        self.message = ""  #: text for the panel, with one line per warning
        self._shown: Optional[List[np.ndarray]] = None
        self._pose_of: Optional[List[np.ndarray]] = None
        self._job: Optional[Job] = None
        self._failed_at: Optional[List[np.ndarray]] = None
        #: Whether the mesh may differ from the session's surface, for example after undo.
        self.is_stale = False

    @property
    def is_settled(self) -> bool:
        return _same(self._pose_of, self._shown)

    def respond(self, obj: bpy.types.Object) -> bool:
        """Shows the surface for the Empties' places. Returns False if it is shown already."""
        motions = self.request.motions(obj)
        if _same(motions, self._shown) and not self.is_stale:
            return False
        live_mesh.show(obj, self.response.coordinates(motions))
        self._shown = motions
        self.is_stale = False
        return True

    def settle_step(self, obj: bpy.types.Object) -> None:
        """Takes the settled surface from the thread, and gives it the next one to settle."""
        if self._job is not None:
            if not self._job.is_done:
                return
            job, self._job = self._job, None
            try:
                self._take(*job.result())
                self.respond(obj)
            except Refusal as refusal:
                self.message, self._failed_at = str(refusal), self._shown
        if self._shown is not None and not self.is_settled and not _same(self._failed_at, self._shown):
            self._job = Job(self.settling(self._shown))

    def settling(self, motions: List[np.ndarray]) -> Work:
        def work(progress: Progress) -> Any:
            world, warnings = self.edit.settle(
                self.request.with_pins(motions), self.request.free_handles([motions]), progress
            )
            return motions, world, warnings

        return work

    def _take(self, motions: List[np.ndarray], world: np.ndarray, warnings: List[str]) -> None:
        self.response.set_pose(motions, world)
        self._pose_of = motions
        self.message = "\n".join(warnings)
        self.is_stale = True

    def take(self, obj: bpy.types.Object, settled: Any) -> None:
        """Shows the result of `settling`."""
        self._take(*settled)
        self.respond(obj)

    def coordinates(self) -> np.ndarray:
        """Returns the coordinates of the shown surface in the object's space."""
        if self._shown is None:
            return self.request.rest
        return self.response.coordinates(self._shown)

    def motions(self) -> List[np.ndarray]:
        return self._shown if self._shown is not None else []

    def close(self) -> None:
        if self._job is not None:
            self._job.cancelled = True
            self._job.wait()
        self.edit.close()


def _same(a: Optional[List[np.ndarray]], b: Optional[List[np.ndarray]]) -> bool:
    return a is not None and b is not None and all(np.array_equal(x, y) for x, y in zip(a, b))


def preparing(engine: Any, request: EditRequest) -> Work:
    """Returns the work that creates a Session."""

    def work(progress: Progress) -> Session:
        columns, edit = engine.prepare(request.mesh, request.step, request.frames, progress)
        assert len(columns) == PARAMETERS * len(request.frames)
        inverse = np.linalg.inv(request.matrix)
        response = Response(
            request.frames, request.rest, request.mesh.vertices, columns, inverse
        )
        return Session(request, response, edit)

    return work


def start(obj: bpy.types.Object, session: Session) -> None:
    stop(obj.name)
    _ends.pop(obj.name, None)
    live_mesh.begin(obj)
    settings_of(obj).is_live = True
    _sessions[obj.name] = session
    session.respond(obj)
    if not bpy.app.background and not bpy.app.timers.is_registered(_tick):
        bpy.app.timers.register(_tick, first_interval=_TICK_SECONDS)


def session_of(obj: bpy.types.Object) -> Session:
    session = _sessions.get(obj.name)
    if session is None or not settings_of(obj).is_live:
        raise Refusal(f"'{obj.name}' has no live edit; start one first")
    return session


def has_session(obj: bpy.types.Object) -> bool:
    return obj.name in _sessions and settings_of(obj).is_live


def why_ended(obj: bpy.types.Object) -> str:
    return _ends.get(obj.name, "")


def stop(name: str) -> None:
    session = _sessions.pop(name, None)
    if session is not None:
        session.close()


def stop_all() -> None:
    for name in list(_sessions):
        stop(name)


def _tick() -> Optional[float]:
    for name, session in list(_sessions.items()):
        obj = bpy.data.objects.get(name)
        if obj is None or obj.type != "MESH" or not settings_of(obj).is_live:
            stop(name)  # the object was renamed or deleted, or the live edit was undone
            continue
        if obj.mode == "EDIT":  # in edit mode, Blender edits a copy of the mesh
            session.is_stale = True
            continue
        try:
            advance(obj, session)
        except (Refusal, Cancelled) as refusal:
            session.message = str(refusal)
    return _TICK_SECONDS if _sessions else None


def advance(obj: bpy.types.Object, session: Session) -> None:
    """Updates one live edit in a tick."""
    if len(obj.data.vertices) != len(session.request.rest) or not live_mesh.is_begun(obj):
        stop(obj.name)
        settings_of(obj).is_live = False
        _ends[obj.name] = "The mesh got other vertices or shape keys, which ended the live edit"
        _redraw_panels()
        return
    session.respond(obj)
    before = session.message
    session.settle_step(obj)
    if session.message != before:
        _redraw_panels()


def _redraw_panels() -> None:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


@persistent
def _after_undo(_scene: Any, *_: Any) -> None:
    for session in _sessions.values():
        session.is_stale = True


@persistent
def _after_load(_scene: Any, *_: Any) -> None:
    stop_all()
    _ends.clear()


def local_result(request: EditRequest, world: np.ndarray) -> np.ndarray:
    """Returns `world` in the object's space. Vertices that did not move keep their bits."""
    local = to_local(request.matrix, world)
    still = (world == request.mesh.vertices).all(axis=1)
    local[still] = request.rest[still]
    return local


def register() -> None:
    bpy.app.handlers.undo_post.append(_after_undo)
    bpy.app.handlers.redo_post.append(_after_undo)
    bpy.app.handlers.load_post.append(_after_load)


def unregister() -> None:
    stop_all()
    if bpy.app.timers.is_registered(_tick):
        bpy.app.timers.unregister(_tick)
    bpy.app.handlers.undo_post.remove(_after_undo)
    bpy.app.handlers.redo_post.remove(_after_undo)
    bpy.app.handlers.load_post.remove(_after_load)
