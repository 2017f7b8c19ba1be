"""Edits in a window by mouse and keys: the surface follows a drag or grab and settles; undo
reverts the edit, and Esc cancels it."""

import json
import os
import sys
import threading
import time
import traceback

import bpy
import numpy as np
import scene
from scene import coordinates

#: A loaded machine may need this long for work of a few seconds.
PATIENCE_SECONDS = 60
COAT = dict(region="CURSOR", radius=0.9, detail_size=0.3)


class Window:
    def __init__(self):
        self.window = bpy.context.window_manager.windows[0]
        self.area = next(area for area in self.window.screen.areas if area.type == "VIEW_3D")
        self.region = next(region for region in self.area.regions if region.type == "WINDOW")
        self.x = self.region.x + self.region.width // 2
        self.y = self.region.y + self.region.height // 2

    def context(self):
        return bpy.context.temp_override(window=self.window, area=self.area, region=self.region)

    def event(self, kind, value, **more):
        self.window.event_simulate(type=kind, value=value, x=self.x, y=self.y, **more)

    def press(self, kind, **more):
        self.event(kind, "PRESS", **more)
        self.event(kind, "RELEASE", **more)

    def move_mouse(self, x, y):
        self.x, self.y = self.x + x, self.y + y
        self.event("MOUSEMOVE", "NOTHING")


def until(what, condition):
    """Yields while Blender works, until `condition` holds."""
    end = time.monotonic() + PATIENCE_SECONDS
    while not condition():
        assert time.monotonic() < end, f"this did not happen: {what}"
        yield


def story():
    from lapwing_blender import session

    window = Window()
    window.move_mouse(0, 0)
    yield
    with window.context():
        obj = scene.wavy()
        name, handle = obj.name, scene.empty_of(obj).name
        bpy.ops.ed.undo_push(message="scene")
        bpy.ops.lapwing.start("INVOKE_DEFAULT")
    yield from until("the edit is live", lambda: bpy.data.objects[name].lapwing.is_live)
    live = lambda: session.session_of(bpy.data.objects[name])
    shown = lambda: coordinates(bpy.data.objects[name].data.vertices)
    rest = shown()

    scene.make_active(bpy.data.objects[handle])
    bpy.ops.ed.undo_push(message="handle selected")
    yield
    window.press("G")
    yield
    for _ in range(6):
        window.move_mouse(0, 15)
        yield
    yield from until("the surface follows the mouse", lambda: np.abs(shown() - rest).max() > 0.1)
    window.press("LEFTMOUSE")
    yield from until("the surface settles", lambda: live().is_settled)
    moved = shown()
    assert np.abs(moved - rest).max() > 0.1

    window.press("Z", ctrl=True)
    yield from until("undo takes the surface back", lambda: np.abs(shown() - rest).max() < 1e-6)
    window.press("Z", ctrl=True, shift=True)
    yield from until("redo settles it there again",
                     lambda: live().is_settled and np.abs(shown() - moved).max() < 1e-4)

    with window.context():
        bpy.ops.lapwing.apply("INVOKE_DEFAULT", as_key=True)
    yield from until("there is a shape key", lambda: bpy.data.objects[name].data.shape_keys)
    assert not bpy.data.objects[name].lapwing.is_live

    yield from grab_story(window)

    # Esc cancels a long operation and leaves the mesh unchanged.
    with window.context():
        source = scene.add_mesh("Source", *scene.grid(150, lambda x, y: 0.02 * np.sin(40 * x)))
        target = scene.add_mesh("Target", *scene.grid(150, lambda x, y: 0.1 * y * y))
        scene.make_active(target, source)
        before = coordinates(target.data.vertices)
        bpy.ops.lapwing.coat("INVOKE_DEFAULT", **COAT)
    computes = lambda: any(thread.name == "lapwing" for thread in threading.enumerate())
    yield from until("the engine is at work", computes)
    window.press("ESC")
    yield from until("Esc ends it", lambda: not computes())
    for _ in range(10):
        yield
    assert "lapwing_edits" not in target
    np.testing.assert_array_equal(coordinates(target.data.vertices), before)

    # Without Esc the operation finishes.
    with window.context():
        bpy.ops.lapwing.coat("INVOKE_DEFAULT", **COAT)
    yield from until("the coat is there", lambda: "lapwing_edits" in bpy.data.objects["Target"])


def grab_story(window):
    """The mouse grabs a mesh in the middle of the view, and undo reverts the grab in one step."""
    with window.context():
        for obj in list(bpy.data.objects):
            obj.hide_set(True)
        obj = scene.add_mesh("Sheet", *scene.grid(40, lambda x, y: 0.02 * np.sin(9 * x)))
        bpy.ops.view3d.view_axis(type="TOP")
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="sheet")
    sheet = lambda: bpy.data.objects["Sheet"]
    shown = lambda: coordinates(sheet().data.vertices)
    rest = shown()
    moved = lambda: np.flatnonzero((shown() != rest).any(axis=1))
    yield

    def drag():
        with window.context():
            bpy.ops.lapwing.grab("INVOKE_DEFAULT")
        yield
        window.event("LEFTMOUSE", "PRESS")
        yield
        for _ in range(4):
            window.move_mouse(0, 10)
            yield
        yield from until("the surface follows the mouse", lambda: len(moved()) > 0)

    yield from drag()
    small = len(moved())
    for _ in range(5):
        window.press("WHEELUPMOUSE")
        yield
    yield from until("a larger brush moves more", lambda: len(moved()) > 1.3 * small)
    window.event("LEFTMOUSE", "RELEASE")
    yield from until("the grab is kept", lambda: "lapwing_edits" in sheet())
    assert "lapwing_rest" not in sheet().data.attributes
    handle = json.loads(sheet()["lapwing_edits"])[0]["steps"][0]["handles"][0]
    pull = np.array(handle["move"]["matrix"]).reshape(4, 4)[:3, 3]
    assert abs(pull[2]) < 1e-3 * np.linalg.norm(pull), "it moves in the plane of the view"
    window.press("Z", ctrl=True)
    yield from until("undo reverts the grab in one step", lambda: len(moved()) == 0)
    assert "lapwing_edits" not in sheet()

    yield from drag()
    window.press("ESC")
    yield from until("Esc cancels", lambda: len(moved()) == 0)
    window.event("LEFTMOUSE", "RELEASE")
    yield
    assert "lapwing_edits" not in sheet()


def tell(steps):
    """Continues the story whenever Blender is idle."""
    def step():
        try:
            next(steps)
            return 0.05
        except StopIteration:
            print("OK")
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)


bpy.context.preferences.view.show_splash = False
scene.install()
tell(story())
