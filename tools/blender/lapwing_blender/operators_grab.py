# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator and the tool that grab the surface with the mouse."""

from __future__ import annotations

from typing import Any, Generator, Optional, Set, Tuple

import bpy
import numpy as np
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty
from bpy_extras import view3d_utils
from gpu_extras.presets import draw_circle_2d

from . import grab
from .background import EngineOperator, Work, finished, warn
from .edit_request import check_object, has_mesh
from .errors import Cancelled, Refusal
from .preferences import chosen_engine
from .settings import settings_of

#: Interval between two checks of the threads.
_TICK_SECONDS = 0.02
#: The factor by which one notch of the wheel or one bracket key changes the size of the brush.
_PER_NOTCH = 1.15
_SIZES = {
    "WHEELUPMOUSE": _PER_NOTCH, "WHEELDOWNMOUSE": 1.0 / _PER_NOTCH,
    "RIGHT_BRACKET": _PER_NOTCH, "LEFT_BRACKET": 1.0 / _PER_NOTCH,
}
_LEAST_PIXELS, _MOST_PIXELS = 5, 500
_CIRCLE_COLOR = (1.0, 0.94, 0.78, 0.9)


def reach_of(event: Any) -> float:
    """Returns the factor of the region's radius: Shift halves the radius, Ctrl doubles it."""
    return 0.5 if event.shift else 2.0 if event.ctrl else 1.0


class LAPWING_OT_grab(EngineOperator, bpy.types.Operator):
    bl_idname = "lapwing.grab"
    bl_label = "Lapwing Grab"
    bl_description = (
        "Press on the surface of the active mesh and pull. The region is chosen automatically. "
        "Shift: smaller region, Ctrl: larger region, wheel or [ and ]: size of the brush"
    )
    bl_options = {"REGISTER", "UNDO"}

    vertex: IntProperty(name="Vertex", default=-1, min=-1, options={"SKIP_SAVE"})
    radius: FloatProperty(name="Radius", min=0.0, subtype="DISTANCE", options={"SKIP_SAVE"},
                          description="Radius of the brush along the surface")
    reach: FloatProperty(name="Reach", min=0.01, default=1.0, options={"SKIP_SAVE"},
                         description="Factor that scales the region's radius")
    translation: FloatVectorProperty(name="Pull", subtype="TRANSLATION", options={"SKIP_SAVE"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return (
            has_mesh(context) and context.mode == "OBJECT"
            and not settings_of(context.object).is_live
        )

    # These functions run when a script or the redo panel calls the operator.

    def prepare(self, context: bpy.types.Context) -> Generator[None, None, Work]:
        obj = check_object(context.object)
        engine = chosen_engine(context)
        self._name = obj.name
        request = yield from grab.gather(obj, self.vertex, self.radius, self.reach)
        pull = np.array(self.translation, dtype=np.float64)

        def work(progress: Any) -> Any:
            prepared = grab.PreparedGrab(engine, request, progress)
            try:
                return (prepared, *prepared.settle(pull, progress))
            finally:
                prepared.close()

        return work

    def finish(self, context: bpy.types.Context, value: Any) -> None:
        prepared, world, warnings = value
        pull = np.array(self.translation, dtype=np.float64)
        grab.keep(bpy.data.objects[self._name], prepared, pull, world)
        warn(self, warnings)

    # These functions run when the user grabs with the mouse.

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> Set[str]:
        if bpy.app.background:
            return self.execute(context)
        self._gesture: Optional[grab.Gesture] = None
        is_press = event.type == "LEFTMOUSE" and event.value == "PRESS"
        try:
            if is_press and not self.press(context, event):
                return {"PASS_THROUGH"}  # beside the surface
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return {"CANCELLED"}
        manager = context.window_manager
        manager.modal_handler_add(self)
        self._timer = manager.event_timer_add(_TICK_SECONDS, window=context.window)
        self._region, _, self._cursor = _view(context, event)
        self._circle = bpy.types.SpaceView3D.draw_handler_add(
            self._draw_circle, (manager,), "WINDOW", "POST_PIXEL"
        )
        self._say(context)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> Set[str]:
        try:
            return self._hear(context, event)
        except Refusal as refusal:
            self.report({"ERROR"}, str(refusal))
            return self._give_up(context)
        except Cancelled:
            return self._give_up(context)
        except BaseException:
            self._give_up(context)
            raise

    def _hear(self, context: bpy.types.Context, event: bpy.types.Event) -> Set[str]:
        is_press = event.value == "PRESS"
        if event.type == "MOUSEMOVE":
            _, _, self._cursor = _view(context, event)
            self._region.tag_redraw()
        if event.type in ("ESC", "RIGHTMOUSE") and is_press:
            return self._give_up(context)
        if event.type in _SIZES and is_press:
            self._resize(context, _SIZES[event.type])
        elif self._gesture is None:
            if event.type == "LEFTMOUSE" and is_press:
                self.press(context, event)
            elif event.type in ("MIDDLEMOUSE", "MOUSEMOVE"):
                return {"PASS_THROUGH"}
        elif event.type == "MOUSEMOVE" and not self._is_released:
            self._gesture.drag(self._place(context, event) - self._hit)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._is_released = True
            self._gesture.release()
            if not self._gesture.is_pulled:
                return self._give_up(context)  # a grab that moves nothing is not a step
        elif event.type == "TIMER" and self._gesture.advance():
            return self._keep(context)
        return {"RUNNING_MODAL"}

    def press(self, context: bpy.types.Context, event: Any) -> bool:
        """Starts a grab. Returns False if the cursor is not on the surface."""
        obj = check_object(context.object)
        region, view, cursor = _view(context, event)
        found = grab.picked(
            obj, view3d_utils.region_2d_to_origin_3d(region, view, cursor),
            view3d_utils.region_2d_to_vector_3d(region, view, cursor),
        )
        if found is None:
            return False
        self.vertex, self._hit = found
        beside = view3d_utils.region_2d_to_location_3d(
            region, view, (cursor[0] + 1.0, cursor[1]), self._hit
        )
        self._pixel = float(np.linalg.norm(np.array(beside) - self._hit))
        self.radius = context.window_manager.lapwing_grab_pixels * self._pixel
        self.reach = reach_of(event)
        self._name = obj.name
        self._is_released = False
        self._gesture = grab.Gesture(obj, chosen_engine(context), self._request(obj))
        return True

    def _request(self, obj: bpy.types.Object) -> grab.GrabRequest:
        return finished(grab.gather(obj, self.vertex, self.radius, self.reach))

    def _resize(self, context: bpy.types.Context, factor: float) -> None:
        manager = context.window_manager
        pixels = factor * manager.lapwing_grab_pixels
        manager.lapwing_grab_pixels = min(max(pixels, _LEAST_PIXELS), _MOST_PIXELS)
        self._say(context)
        self._region.tag_redraw()
        if self._gesture is not None and not self._is_released:
            self.radius = manager.lapwing_grab_pixels * self._pixel
            self._gesture.resize(self._request(self._gesture.obj))

    def _place(self, context: bpy.types.Context, event: Any) -> np.ndarray:
        """Returns the position of the cursor in the plane through the grabbed point that is
        parallel to the image."""
        region, view, cursor = _view(context, event)
        return np.array(view3d_utils.region_2d_to_location_3d(region, view, cursor, self._hit))

    def _keep(self, context: bpy.types.Context) -> Set[str]:
        self.translation = self._gesture.pull
        warn(self, self._gesture.warnings)
        self._gesture.finish()
        return self._over(context, {"FINISHED"})

    def _give_up(self, context: bpy.types.Context) -> Set[str]:
        if self._gesture is not None:
            self._gesture.cancel()
        return self._over(context, {"CANCELLED"})

    def _over(self, context: bpy.types.Context, answer: Set[str]) -> Set[str]:
        self._gesture = None
        bpy.types.SpaceView3D.draw_handler_remove(self._circle, "WINDOW")
        self._region.tag_redraw()
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        return answer

    def _draw_circle(self, manager: bpy.types.WindowManager) -> None:
        if bpy.context.region == self._region:
            draw_circle_2d(self._cursor, _CIRCLE_COLOR, manager.lapwing_grab_pixels, segments=64)

    def _say(self, context: bpy.types.Context) -> None:
        context.workspace.status_text_set(
            f"Lapwing Grab: drag the surface (brush {context.window_manager.lapwing_grab_pixels:.0f} "
            "px; wheel or [ ] resizes it, Shift: smaller region, Ctrl: larger region, Esc cancels)"
        )


def _view(context: bpy.types.Context, event: Any) -> Tuple[Any, Any, Tuple[float, float]]:
    """Returns the 3D view's region, its camera, and the cursor in the region. The operator may have
    been called from the sidebar, which is another region."""
    region = next(each for each in context.area.regions if each.type == "WINDOW")
    cursor = (float(event.mouse_x - region.x), float(event.mouse_y - region.y))
    return region, context.space_data.region_3d, cursor


class LapwingGrabTool(bpy.types.WorkSpaceTool):
    bl_space_type = "VIEW_3D"
    bl_context_mode = "OBJECT"
    bl_idname = "lapwing.grab_tool"
    bl_label = "Lapwing Grab"
    bl_description = LAPWING_OT_grab.bl_description
    bl_icon = "brush.sculpt.grab"
    bl_keymap = tuple(
        ("lapwing.grab", {"type": "LEFTMOUSE", "value": "PRESS", **keys}, None)
        for keys in ({}, {"shift": True}, {"ctrl": True})
    )


def register() -> None:
    bpy.types.WindowManager.lapwing_grab_pixels = FloatProperty(
        name="Grab Radius", default=40.0, min=_LEAST_PIXELS, max=_MOST_PIXELS, subtype="PIXEL",
        description="Radius of the brush of Lapwing Grab on the screen",
    )
    bpy.utils.register_tool(LapwingGrabTool, separator=True)


def unregister() -> None:
    bpy.utils.unregister_tool(LapwingGrabTool)
    del bpy.types.WindowManager.lapwing_grab_pixels


CLASSES = (LAPWING_OT_grab,)
