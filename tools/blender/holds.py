# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how long the add-on blocks Blender's window at a time, at about 100,000 vertices.

    LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 480x360x24" \
      blender --factory-startup --window-geometry 0 0 480 360 --python-exit-code 1 \
      --python tools/blender/holds.py -- MODULE [SIDE]

MODULE is the folder of the Python module `lapwing`, SIDE the number of cells along a bumpy square
sheet (316). The script starts, moves, settles and applies an edit, and makes a coat and a peel. For
each phase it prints the longest

    call      of the add-on on Blender's main thread: a slice of reading, a tick, writing a result
    lock      wait of another thread for Python's lock, which may also block the main thread
    machine   wait of an idle process for a processor: the noise in both

None of them includes Blender's drawing.
"""

import os
import subprocess
import sys
import threading
import time
import traceback

import bpy
import numpy as np

sys.path[:0] = [os.path.dirname(os.path.abspath(__file__))]
ARGUMENTS = sys.argv[sys.argv.index("--") + 1:]
sys.path.insert(1, os.path.abspath(ARGUMENTS[0]))
SIDE = int(ARGUMENTS[1]) if len(ARGUMENTS) > 1 else 316
FRAMES = 10

import lapwing_blender  # noqa: E402 - beside this file, and installed nowhere
from lapwing_blender import background, recipe_store, session  # noqa: E402

phase = [""]
watching = []
calls, locks, machine = {}, {}, {}


def note(kind, seconds):
    kind[phase[0]] = max(kind.get(phase[0], 0.0), seconds)


def timed(function):
    begin = time.perf_counter()
    try:
        return function()
    finally:
        note(calls, time.perf_counter() - begin)


def watch_calls():
    operator, tick = background.EngineOperator, session._tick
    invoke, modal = operator.invoke, operator.modal

    def timed_invoke(self, context, event):
        return timed(lambda: invoke(self, context, event))

    def timed_modal(self, context, event):
        return timed(lambda: modal(self, context, event))

    operator.invoke, operator.modal = timed_invoke, timed_modal
    session._tick = lambda: timed(tick)


def watch_lock():
    last = time.perf_counter()
    while True:
        time.sleep(0.0005)
        now = time.perf_counter()
        note(locks, now - last)
        last = now


#: Prints the duration of each sleep that took a millisecond too long.
NAPS = """
import time
last = time.perf_counter()
while True:
    time.sleep(0.0005)
    now = time.perf_counter()
    if now - last > 0.0015: print(now - last, flush=True)
    last = now
"""


def watch_machine():
    napping = subprocess.Popen([sys.executable, "-c", NAPS], stdout=subprocess.PIPE, text=True)
    watching.append(napping)
    for line in napping.stdout:
        note(machine, float(line))


def sheet(name, side):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=side, y_subdivisions=side, size=2.0)
    obj = bpy.context.object
    obj.name = name
    flat = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", flat)
    points = flat.reshape(-1, 3)
    points[:, 2] = 0.02 * np.sin(25.0 * points[:, 0]) * np.cos(20.0 * points[:, 1])
    obj.data.vertices.foreach_set("co", flat)
    obj.data.update()
    return obj, np.abs(points[:, :2]).max(axis=1)


def story():
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")

    def call(operator, **properties):
        with bpy.context.temp_override(window=window, area=area, region=region):
            operator("INVOKE_DEFAULT", **properties)

    for each in list(bpy.data.objects):
        bpy.data.objects.remove(each)
    source, _ = sheet("Source", 40)
    source.location.x = 9.0
    obj, away = sheet("Sheet", SIDE)
    for name, held in (("Region", away < 0.99), ("Belt", (away > 0.95) & (away < 0.99))):
        obj.vertex_groups.new(name=name).add(np.flatnonzero(held).tolist(), 1.0, "REPLACE")
    obj.lapwing.roi, obj.lapwing.belt = "Region", "Belt"
    obj.data.vertices.foreach_set("select", away < 0.1)
    with bpy.context.temp_override(window=window, area=area, region=region):
        bpy.ops.lapwing.add_handle()
    for _ in range(5):
        yield

    phase[0] = "start"
    call(bpy.ops.lapwing.start)
    while not obj.lapwing.is_live:
        yield
    phase[0] = "drag"
    for _ in range(FRAMES):
        obj.lapwing.handles[0].empty.location.z += 0.03
        yield
    phase[0] = "settle"
    while not session.session_of(obj).is_settled:
        yield
    for name, operator, properties in (
        ("apply", bpy.ops.lapwing.apply, {}),
        ("peel", bpy.ops.lapwing.peel, dict(region="GROUP", group="Region", detail_size=0.1)),
        ("coat", bpy.ops.lapwing.coat,
         dict(region="CURSOR", radius=0.3, detail_size=0.2, source="Source")),
    ):
        phase[0] = name
        before = len(recipe_store.edits_of(obj))
        call(operator, **properties)
        while len(recipe_store.edits_of(obj)) == before:
            yield
    phase[0] = ""
    print(f"\n{(SIDE + 1) ** 2:,} vertices, Blender {bpy.app.version_string}\n")
    print("| | longest call | longest wait for the lock | for the machine |\n|---|---|---|---|")
    for name in calls:
        if name:
            cells = [f"{1e3 * kind.get(name, 0.0):.0f} ms" for kind in (calls, locks, machine)]
            print(f"| {name} | {' | '.join(cells)} |")


def tell(steps):
    def step():
        try:
            next(steps)
            return 0.02
        except StopIteration:
            code = 0
        except BaseException:
            traceback.print_exc()
            code = 1
        for process in watching:
            process.kill()
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)


bpy.context.preferences.view.show_splash = False
watch_calls()
lapwing_blender.register()
threading.Thread(target=watch_lock, daemon=True).start()
threading.Thread(target=watch_machine, daemon=True).start()
tell(story())
