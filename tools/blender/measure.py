# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares the live response of the add-on with Blender's Laplacian Deform modifier.

    blender -b --factory-startup --python tools/blender/measure.py -- [--engine PATH] [SIDE...]

A SIDE is the number of cells along a bumpy square sheet; the defaults give about 26,000 and 100,000
vertices. Both hold the outer tenth of the sheet and move its middle by one Empty: the modifier by a
Hook before it, the add-on by a handle. Prints medians:

    bind      until the first frame can be shown
    response  from the moved Empty to the new coordinates in the mesh. For the modifier, a frame
              with it minus a frame with the Hook alone
    frame     the same with all of Blender's work for a frame except drawing, for both
    settled   from there to the surface of least energy, for which the modifier has no counterpart
"""

import os
import statistics
import sys
import time

import bpy
import numpy as np
from mathutils import Matrix

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

FRAMES = 21
SETTLES = 7
BINDS = 3


def seconds(act):
    begin = time.perf_counter()
    act()
    return time.perf_counter() - begin


def sheet(side):
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=side, y_subdivisions=side, size=2.0)
    obj = bpy.context.object
    flat = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", flat)
    points = flat.reshape(-1, 3)
    points[:, 2] = 0.02 * np.sin(25.0 * points[:, 0]) * np.cos(20.0 * points[:, 1])
    obj.data.vertices.foreach_set("co", flat)
    obj.data.update()
    away = np.abs(points[:, :2]).max(axis=1)
    return obj, away < 0.1, away > 0.95


def group(obj, name, mask):
    obj.vertex_groups.new(name=name).add(np.flatnonzero(mask).tolist(), 1.0, "REPLACE")
    return name


def place(k):
    """Returns the Empty's matrix in frame k. No two frames have the same motion."""
    return Matrix.Translation((0.0, 0.0, 0.1 + 0.01 * k)) @ Matrix.Rotation(0.02 * k, 4, "X")


def frames(empty, act):
    """Returns the median time of `act` after the Empty has moved."""
    times = []
    for k in range(FRAMES):
        empty.matrix_world = place(k)
        bpy.context.view_layer.update()
        times.append(seconds(act))
    return statistics.median(times)


def frames_with_update(empty, act):
    def whole(k):
        empty.matrix_world = place(k)
        act()
        bpy.context.view_layer.update()

    return statistics.median([seconds(lambda: whole(k)) for k in range(FRAMES)])


def measure_modifier(side):
    obj, held, belt = sheet(side)
    handle = group(obj, "Handle", held)
    group(obj, "Anchors", held | belt)
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.scene.collection.objects.link(empty)
    hook = obj.modifiers.new("Hook", "HOOK")
    hook.object, hook.vertex_group = empty, handle
    bpy.context.view_layer.update()
    hook_alone = frames_with_update(empty, lambda: None)

    laplacian = obj.modifiers.new("Laplacian", "LAPLACIANDEFORM")
    laplacian.vertex_group = "Anchors"
    empty.matrix_world = Matrix.Identity(4)
    bpy.context.view_layer.update()

    def bind():
        bpy.ops.object.laplaciandeform_bind(modifier="Laplacian")
        bpy.context.view_layer.update()

    bpy.context.view_layer.objects.active = obj
    bound = []
    for _ in range(BINDS):
        if laplacian.is_bind:
            bpy.ops.object.laplaciandeform_bind(modifier="Laplacian")  # toggles: unbinds
        bound.append(seconds(bind))
    if not laplacian.is_bind:
        return None
    frame = frames_with_update(empty, lambda: None)
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    assert max(v.co.z for v in shown.vertices) > 0.2, "the modifier does not follow"
    return {"bind": statistics.median(bound), "response": frame - hook_alone, "frame": frame}


def measure_addon(side):
    from lapwing_blender import session

    obj, held, belt = sheet(side)
    obj.lapwing.roi = group(obj, "Region", np.ones_like(held))
    obj.lapwing.belt = group(obj, "Belt", belt)
    obj.data.vertices.foreach_set("select", held)
    bpy.ops.lapwing.add_handle()
    empty = obj.lapwing.handles[0].empty
    bound = []
    for _ in range(BINDS):
        if obj.lapwing.is_live:
            bpy.ops.lapwing.cancel()
        bound.append(seconds(bpy.ops.lapwing.start))
    live = session.session_of(obj)
    response = frames(empty, lambda: live.respond(obj))
    frame = frames_with_update(empty, lambda: (bpy.context.view_layer.update(), live.respond(obj)))
    settles = []
    for k in range(SETTLES):
        empty.matrix_world = place(3 * k)
        bpy.context.view_layer.update()
        settles.append(seconds(bpy.ops.lapwing.settle))
    return {
        "bind": statistics.median(bound), "response": response, "frame": frame,
        "settled": statistics.median(settles),
    }


def row(name, measured):
    if measured is None:
        return f"| {name} | refused to bind | | | |"
    columns = ("bind", "response", "frame", "settled")
    cells = [f"{1e3 * measured[key]:.2f} ms" if key in measured else "" for key in columns]
    return f"| {name} | {' | '.join(cells)} |"


def main():
    arguments = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    engine = ""
    if "--engine" in arguments:
        at = arguments.index("--engine")
        engine = os.path.abspath(arguments[at + 1])
        del arguments[at:at + 2]
    import lapwing_blender

    lapwing_blender.register()  # the package beside this file, not the installed add-on
    if engine:
        sys.path.insert(0, engine)
    for side in [int(a) for a in arguments] or [161, 316]:
        addon, modifier = measure_addon(side), measure_modifier(side)
        print(f"\n{(side + 1) ** 2:,} vertices, Blender {bpy.app.version_string}\n")
        print("| | bind | response | frame | settled |\n|---|---|---|---|---|")
        print(row("Lapwing", addon))
        print(row("Laplacian Deform", modifier))
        if modifier is not None:
            ratios = [f"{modifier[key] / addon[key]:.1f}" for key in ("bind", "response", "frame")]
            print(f"| ratio | {' | '.join(ratios)} | |")


main()
