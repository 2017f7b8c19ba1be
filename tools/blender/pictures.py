# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the pictures of tools/blender/README.md in Blender's own window, by mouse and keys.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1280x800x24" \
      blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 800 \
      --python tools/blender/pictures.py -- MODULE MESH FOLDER

MODULE is the folder of the Python module `lapwing`. MESH is the scan of an armadillo
(build/models/cgal/meshes/armadillo.off). The script raises its arm.
"""

import math
import os
import sys
import traceback

import bpy
import numpy as np
from mathutils import Euler

HERE = os.path.dirname(os.path.abspath(__file__))
MODULE, MESH, FOLDER = sys.argv[sys.argv.index("--") + 1:]
sys.path[:0] = [HERE, os.path.abspath(MODULE)]

#: As in tools/recipes/raise-arm.json.
ARM = {"disk": {"center": 969, "radius": 72}}
HAND = {"disk": {"center": 969, "radius": 27}}
#: Position of the add-on's tab in a window of 1280 x 800; Blender 3.4 has no call to choose it.
#: Then the positions of its other two panels, which are closed at first.
TAB = (1044, 548)
RECIPE_PANEL, DETAIL_PANEL = (900, 220), (900, 248)
STEPS = 3
PIXELS_A_STEP = (-35, 30)


class Window:
    def __init__(self):
        self.window = bpy.context.window_manager.windows[0]
        self.area = next(area for area in self.window.screen.areas if area.type == "VIEW_3D")
        self.x = self.y = 0

    def region(self, kind):
        return next(region for region in self.area.regions if region.type == kind)

    def context(self):
        return bpy.context.temp_override(window=self.window, area=self.area, region=self.region("WINDOW"))

    def mouse(self, x, y, kind="MOUSEMOVE", value="NOTHING"):
        self.x, self.y = int(x), int(y)
        self.window.event_simulate(type=kind, value=value, x=self.x, y=self.y)

    def press(self, kind):
        for value in ("PRESS", "RELEASE"):
            self.window.event_simulate(type=kind, value=value, x=self.x, y=self.y)

    def picture(self, name):
        with self.context():
            bpy.ops.screen.screenshot(filepath=os.path.join(os.path.abspath(FOLDER), name + ".png"))


def scan():
    import lapwing

    mesh = lapwing.read(MESH)
    edit = lapwing.Deformer(mesh, roi=ARM, handles=[HAND])
    made = bpy.data.meshes.new("Armadillo")
    made.from_pydata((mesh.vertices / 60.0).tolist(), [], mesh.faces.tolist())
    made.polygons.foreach_set("use_smooth", np.ones(len(made.polygons), bool))
    obj = bpy.data.objects.new("Armadillo", made)
    bpy.context.scene.collection.objects.link(obj)
    obj.rotation_euler = (math.pi / 2, 0.0, math.pi)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    obj.vertex_groups.new(name="Arm").add(edit.roi.tolist(), 1.0, "REPLACE")
    obj.lapwing.roi = "Arm"
    made.vertices.foreach_set("select", np.isin(np.arange(len(made.vertices)), edit.handles[0]))
    bpy.context.view_layer.update()
    bpy.ops.lapwing.add_handle()
    return obj


def pauses(count):
    for _ in range(count):
        yield


def story():
    window = Window()
    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    space = window.area.spaces.active
    space.show_region_ui = True
    space.overlay.show_floor = space.overlay.show_cursor = False
    space.overlay.show_axis_x = space.overlay.show_axis_y = False
    space.shading.show_cavity = True
    with window.context():
        obj = scan()
        view = space.region_3d
        view.view_rotation = Euler((math.radians(82), 0.0, math.radians(12))).to_quaternion()
        view.view_perspective = "PERSP"
        view.view_distance = 5.0
        view.view_location = (0.0, 0.0, 0.3)
    yield from pauses(3)
    window.mouse(*TAB)
    window.press("LEFTMOUSE")
    yield from pauses(4)
    window.picture("panel")

    from lapwing_blender import recipe_store, session

    with window.context():
        bpy.ops.lapwing.start("INVOKE_DEFAULT")
    while not obj.lapwing.is_live or not session.session_of(obj).is_settled:
        yield
    bpy.ops.object.select_all(action="DESELECT")
    empty = obj.lapwing.handles[0].empty
    empty.select_set(True)
    bpy.context.view_layer.objects.active = empty
    view3d = window.region("WINDOW")
    window.mouse(view3d.x + view3d.width // 2, view3d.y + view3d.height // 2)
    yield from pauses(2)
    window.press("G")
    yield
    for step in range(1, STEPS + 1):
        for _ in range(4):
            window.mouse(window.x + PIXELS_A_STEP[0] / 4, window.y + PIXELS_A_STEP[1] / 4)
            yield
        yield from pauses(6)
        window.picture(f"drag-{step}")
    window.press("LEFTMOUSE")
    yield
    while not session.session_of(obj).is_settled:
        yield
    bpy.ops.object.select_all(action="DESELECT")
    obj.select_set(True)
    bpy.context.view_layer.objects.active = obj
    with window.context():
        bpy.ops.lapwing.apply("INVOKE_DEFAULT", as_key=True)
    while obj.lapwing.is_live:
        yield
    yield from pauses(4)
    window.picture("result")
    for place in (RECIPE_PANEL, DETAIL_PANEL):
        window.mouse(*place)
        window.press("LEFTMOUSE")
        yield from pauses(2)
    window.mouse(view3d.x + 250, view3d.y + 250)
    with window.context():
        bpy.ops.lapwing.peel("INVOKE_DEFAULT", region="ALL", detail_size=0.15)
    while len(recipe_store.edits_of(obj)) < 2:
        yield
    yield from pauses(2)
    window.press("F9")
    yield from pauses(3)
    window.picture("peel")


def tell(steps):
    def step():
        try:
            next(steps)
            return 0.1
        except StopIteration:
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)


bpy.context.preferences.view.show_splash = False
os.makedirs(FOLDER, exist_ok=True)
import lapwing_blender  # noqa: E402 - beside this file, and installed nowhere

lapwing_blender.register()
tell(story())
