"""Lapwing Grab: one press chooses the region and the handle, and pulls the surface."""

import time

import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import CLI, SceneTest, coordinates, diagonal, export, in_world, make_active, run_recipe

#: On a busy machine, one second of work may take this long.
PATIENCE_SECONDS = 60
PULL = (0.0, 0.0, 0.3)
UNEVEN = Matrix.Translation((1, 2, 3)) @ Matrix.Diagonal((2, 1, 0.5, 1))


def sheet(matrix=None, n=40):
    return scene.add_mesh("Sheet", *scene.grid(n, lambda x, y: 0.02 * np.sin(9 * x)), matrix)


def middle_of(obj):
    place = coordinates(obj.data.vertices)
    return int(np.argmin(np.hypot(place[:, 0], place[:, 1])))


#: With this radius, no vertex lies exactly at the border of the region, where rounding would
#: decide whether it moves.
RADIUS = 0.21


def grab_middle(obj, radius=RADIUS, **properties):
    vertex = middle_of(obj)
    bpy.ops.lapwing.grab(vertex=vertex, radius=radius, translation=PULL, **properties)
    return vertex


def moved_part(before, obj):
    return np.flatnonzero((coordinates(obj.data.vertices) != before).any(axis=1))


class Grab(SceneTest):
    def test_pulls_the_vertex_and_leaves_what_is_outside_its_region(self):
        for matrix in (None, UNEVEN):
            bpy.ops.wm.read_homefile(use_empty=True)
            obj = sheet(matrix)
            rest = coordinates(obj.data.vertices)
            before = in_world(obj, rest)
            vertex = grab_middle(obj)
            change = in_world(obj, coordinates(obj.data.vertices)) - before
            np.testing.assert_allclose(change[vertex], PULL, atol=0.01)
            away = np.linalg.norm(before - before[vertex], axis=1)
            self.assertLess(away[moved_part(rest, obj)].max(), 0.7, "three brush radii")
            self.assertNotIn("lapwing_rest", obj.data.attributes)

    def test_a_smaller_or_larger_reach_moves_less_or_more(self):
        parts = []
        for reach in (0.5, 1.0, 2.0):
            bpy.ops.wm.read_homefile(use_empty=True)
            obj = sheet()
            rest = coordinates(obj.data.vertices)
            grab_middle(obj, radius=0.12, reach=reach)
            parts.append(len(moved_part(rest, obj)))
        self.assertLess(2 * parts[0], parts[1])
        self.assertLess(2 * parts[1], parts[2])

    def test_is_one_step_of_the_recipe(self):
        obj = sheet(UNEVEN)
        grab_middle(obj)
        made = in_world(obj, coordinates(obj.data.vertices))
        expected = run_recipe(export())
        self.assertLess(np.abs(made - expected).max(), 1e-6 * diagonal(expected))

    def test_mirrors_with_x_symmetry(self):
        obj = sheet()
        obj.data.use_mirror_x = True
        place = coordinates(obj.data.vertices)
        right = int(np.argmin(np.hypot(place[:, 0] - 0.6, place[:, 1])))
        left = int(np.argmin(np.hypot(place[:, 0] + 0.6, place[:, 1])))
        bpy.ops.lapwing.grab(vertex=right, radius=0.1, translation=PULL)
        change = coordinates(obj.data.vertices) - place
        np.testing.assert_allclose(change[right], PULL, atol=0.01)
        np.testing.assert_allclose(change[left], PULL, atol=0.02)

    def test_is_undone_in_one_step(self):
        obj = sheet()
        rest = coordinates(obj.data.vertices)
        bpy.ops.ed.undo_push(message="scene")
        grab_middle(obj)
        bpy.ops.ed.undo_push(message="grab")
        bpy.ops.ed.undo()
        obj = bpy.data.objects["Sheet"]
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)
        self.assertNotIn("lapwing_edits", obj)

    def test_refusals_name_the_next_step(self):
        obj = sheet()
        self.assert_refused("press on the surface", bpy.ops.lapwing.grab)
        scene.use_engine(CLI)
        self.assert_refused("as a Python module", bpy.ops.lapwing.grab,
                            vertex=middle_of(obj), radius=0.2, translation=PULL)


class Gesture(SceneTest):
    """Tests the gesture as the mouse drives it, without a window."""

    def begin(self, obj, vertex, radius=RADIUS, reach=1.0):
        from lapwing_blender import grab
        from lapwing_blender.background import finished
        from lapwing_blender.preferences import chosen_engine

        request = lambda radius: finished(grab.gather(obj, vertex, radius, reach))
        return grab.Gesture(obj, chosen_engine(bpy.context), request(radius)), request

    def until(self, gesture, condition):
        end = time.monotonic() + PATIENCE_SECONDS
        while not condition():
            self.assertLess(time.monotonic(), end)
            gesture.advance()
            time.sleep(0.005)

    def released(self, gesture):
        gesture.release()
        end = time.monotonic() + PATIENCE_SECONDS
        while not gesture.advance():
            self.assertLess(time.monotonic(), end)
            time.sleep(0.005)

    def test_a_ray_picks_the_nearest_vertex_of_a_moved_object(self):
        from lapwing_blender import grab

        obj = sheet(UNEVEN)
        make_active(obj)
        place = in_world(obj, coordinates(obj.data.vertices))
        vertex = middle_of(obj)
        above = place[vertex] + (0.001, 0.0, 5.0)
        found, hit = grab.picked(obj, above, (0.0, 0.0, -1.0))
        self.assertEqual(found, vertex)
        np.testing.assert_allclose(hit, place[vertex], atol=0.02)
        self.assertIsNone(grab.picked(obj, above, (0.0, 0.0, 1.0)))

    def test_the_surface_follows_and_settles_where_it_is_released(self):
        obj = sheet()
        rest, vertex = coordinates(obj.data.vertices), middle_of(obj)
        gesture, _ = self.begin(obj, vertex)
        gesture.drag((0.0, 0.0, 0.1))
        height = lambda: coordinates(obj.data.vertices)[vertex, 2] - rest[vertex, 2]
        self.until(gesture, lambda: height() > 0.09)
        gesture.drag(PULL)
        self.assertAlmostEqual(height(), 0.3, delta=0.03)
        self.released(gesture)
        gesture.finish()
        by_mouse = coordinates(obj.data.vertices)
        bpy.ops.wm.read_homefile(use_empty=True)
        other = sheet()
        grab_middle(other)
        self.assertLess(np.abs(by_mouse - coordinates(other.data.vertices)).max(), 1e-5)

    def test_a_larger_brush_continues_the_pull(self):
        obj = sheet()
        rest, vertex = coordinates(obj.data.vertices), middle_of(obj)
        gesture, request = self.begin(obj, vertex)
        gesture.drag(PULL)
        self.until(gesture, lambda: len(moved_part(rest, obj)) > 0)
        small = len(moved_part(rest, obj))
        gesture.resize(request(0.3))
        self.released(gesture)
        gesture.finish()
        self.assertGreater(len(moved_part(rest, obj)), 1.5 * small)

    def test_cancelling_brings_every_bit_back(self):
        obj = sheet()
        rest = coordinates(obj.data.vertices)
        gesture, _ = self.begin(obj, middle_of(obj))
        gesture.drag(PULL)
        self.until(gesture, lambda: len(moved_part(rest, obj)) > 0)
        gesture.cancel()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)
        self.assertNotIn("lapwing_rest", obj.data.attributes)
        self.assertNotIn("lapwing_edits", obj)

    def test_shift_and_ctrl_change_the_reach(self):
        from types import SimpleNamespace

        from lapwing_blender.operators_grab import reach_of

        for shift, ctrl, reach in ((False, False, 1.0), (True, False, 0.5), (False, True, 2.0)):
            self.assertEqual(reach_of(SimpleNamespace(shift=shift, ctrl=ctrl)), reach)


scene.main()
