# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work runs on a thread of the engine, while the window stays responsive.

`prepare` reads Blender's data on the main thread, in slices, and returns the work. The work must
not touch Blender's data. `finish` writes its value back on the main thread.
"""

from __future__ import annotations

import threading
import time
from typing import Any, Callable, Generator, Optional, Set

import bpy

from .engine import Progress
from .errors import Cancelled, Refusal

Work = Callable[[Progress], Any]
#: Duration of a slice of reading, and interval between two checks of the thread.
_SLICE_SECONDS = 0.03
#: Events that the user may trigger while the thread works. They change the view, not the scene.
_VIEW_EVENTS = {
    "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE", "MOUSEMOVE", "TRACKPADPAN", "TRACKPADZOOM",
}


class Job:
    def __init__(self, work: Work) -> None:
        self.stage, self.fraction = "", 0.0
        self.cancelled = False
        self.value: Any = None
        self.error: Optional[BaseException] = None
        self._thread = threading.Thread(
            target=self._run, args=(work,), name="lapwing", daemon=True
        )
        self._thread.start()

    def _run(self, work: Work) -> None:
        try:
            self.value = work(self._hear)
        except BaseException as error:  # `result` raises it on the main thread
            self.error = error

    def _hear(self, stage: str, fraction: float) -> bool:
        self.stage, self.fraction = stage, fraction
        return not self.cancelled

    @property
    def is_done(self) -> bool:
        return not self._thread.is_alive()

    def wait(self) -> None:
        self._thread.join()

    def result(self) -> Any:
        if self.error is not None:
            raise self.error
        return self.value


def finished(steps: Generator[None, None, Any]) -> Any:
    """Returns the value of a generator, without pauses."""
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            return stop.value


class EngineOperator:
    """Mixin for an operator. With a window it runs on a thread. From a script, in background mode,
    or again from the redo panel, it runs to its end at once. Redo cannot wait for a thread:
    Blender undoes the step and calls `execute`, and if that has not finished when it returns,
    restores the old step."""

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        raise NotImplementedError

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> Set[str]:
        manager = context.window_manager

        def heard(_stage: str, fraction: float) -> bool:
            manager.progress_update(fraction)  # the cursor, because Blender does not draw meanwhile
            return True

        manager.progress_begin(0.0, 1.0)
        try:
            work = finished(self.prepare(context))
            self.finish(context, work(heard))
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        finally:
            manager.progress_end()
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> Set[str]:
        if bpy.app.background:
            return self.execute(context)
        self._job = None
        self._steps = self.prepare(context)
        manager = context.window_manager
        manager.modal_handler_add(self)
        manager.progress_begin(0.0, 1.0)
        self._timer = manager.event_timer_add(_SLICE_SECONDS, window=context.window)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> Set[str]:
        if event.type == "ESC" and event.value == "PRESS":
            if self._job is None:
                return self._ended(context, {"CANCELLED"})
            self._job.cancelled = True
        if event.type != "TIMER":
            return {"PASS_THROUGH"} if event.type in _VIEW_EVENTS else {"RUNNING_MODAL"}
        try:
            if self._job is None:
                self._read_on(context)
            elif self._job.is_done:
                if self._job.cancelled:
                    return self._ended(context, {"CANCELLED"})
                self.finish(context, self._job.result())
                return self._ended(context, {"FINISHED"})
            else:
                job = self._job
                self._show(context, f"{job.stage} {job.fraction:.0%}", job.fraction)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return self._ended(context, {"CANCELLED"})
        except Cancelled:
            return self._ended(context, {"CANCELLED"})
        except BaseException:
            self._ended(context, {"CANCELLED"})
            raise
        return {"RUNNING_MODAL"}

    def _read_on(self, context: bpy.types.Context) -> None:
        until = time.monotonic() + _SLICE_SECONDS
        try:
            while time.monotonic() < until:
                next(self._steps)
            self._show(context, "reading the mesh", 0.0)
        except StopIteration as stop:
            self._job = Job(stop.value)

    def _show(self, context: bpy.types.Context, stage: str, fraction: float) -> None:
        context.window_manager.progress_update(fraction)
        context.workspace.status_text_set(f"{self.bl_label}: {stage} (Esc cancels)")

    def _ended(self, context: bpy.types.Context, answer: Set[str]) -> Set[str]:
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        context.workspace.status_text_set(None)
        return answer


def warn(operator: Any, warnings: Any) -> None:
    for text in warnings:
        operator.report({"WARNING"}, text)
