"""A live edit, from its region to its result."""

import json

import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import SceneTest, coordinates, deform, diagonal, drag, export, in_world, lift, move, run_recipe, wavy

TOLERANCE = 1e-6

#: World matrices of objects.
PLACES = {
    "at the origin": Matrix.Identity(4),
    "turned and moved": Matrix.Translation((3, -2, 5)) @ Matrix.Rotation(1.0, 4, (1, 2, 3)),
    "of uneven scale": Matrix.Diagonal((2, 1, 0.5, 1)),
    "of negative scale": Matrix.Translation((1, 1, 1)) @ Matrix.Diagonal((-1, 2, 1, 1)),
}


class LiveEdit(SceneTest):
    def test_the_settled_surface_is_that_of_the_command_line(self):
        for place, matrix in PLACES.items():
            with self.subTest(place):
                bpy.ops.wm.read_homefile(use_empty=True)
                obj = wavy(matrix)
                deform(obj, as_key=True)
                made = in_world(obj, coordinates(obj.data.shape_keys.key_blocks["Lapwing"].data))
                expected = run_recipe(export())
                self.assertGreater(np.abs(expected - in_world(obj, coordinates(obj.data.vertices))).max(), 0.1)
                self.assertLess(np.abs(made - expected).max(), TOLERANCE * diagonal(expected))

    def test_the_live_response_is_the_engine_s_linear_one(self):
        obj = wavy(PLACES["of uneven scale"])
        drag(obj)
        shown = in_world(obj, coordinates(obj.data.vertices))
        bpy.ops.lapwing.apply(as_key=True)
        path = export()
        recipe = path.read_text().replace('"op": "deform"', '"op": "deform", "settle": false')
        self.assertIn('"settle": false', recipe)
        path.write_text(recipe)
        expected = run_recipe(path)
        self.assertLess(np.abs(shown - expected).max(), TOLERANCE * diagonal(expected))

    def test_a_painted_group_is_rigid_stiff_or_soft(self):
        obj = wavy()
        points = coordinates(obj.data.vertices)
        distance = np.hypot(points[:, 0] - 0.45, points[:, 1])
        group = obj.vertex_groups.new(name="Bones")
        for v in np.flatnonzero(distance < 0.4):
            group.add([int(v)], 1.0 if distance[v] < 0.2 else 0.5 if distance[v] < 0.3 else 0.0,
                      "REPLACE")
        obj.lapwing.stiffness = "Bones"
        deform(obj)
        made = coordinates(obj.data.vertices)
        bone = np.flatnonzero(distance < 0.2)
        for k in bone:
            lengths = np.linalg.norm(points[bone] - points[k], axis=1)
            np.testing.assert_allclose(np.linalg.norm(made[bone] - made[k], axis=1), lengths, atol=1e-4)
        recipe = json.loads(export().read_text())
        field = recipe["steps"][0]["stiffness"][0]["factor"]["field"]
        self.assertEqual({field[v] for v in bone}, {"rigid"})
        self.assertEqual({field[v] for v in np.flatnonzero(distance >= 0.4)}, {1.0})
        self.assertEqual({field[v] for v in np.flatnonzero((distance >= 0.2) & (distance < 0.3))}, {1.0})
        self.assertAlmostEqual(min(f for f in field if f != "rigid"), 0.01)

    def test_frames_go_on_from_the_surface_that_settled_last(self):
        obj = wavy()
        bpy.ops.lapwing.start()
        move(obj, lift())
        bpy.ops.lapwing.settle()
        settled = coordinates(obj.data.vertices)
        move(obj, Matrix.Translation((0, 0, 0.01)))
        bpy.ops.lapwing.respond()
        frame = coordinates(obj.data.vertices)
        bpy.ops.lapwing.settle()
        self.assertGreater(np.abs(frame - settled).max(), 0.005)
        self.assertLess(np.abs(frame - coordinates(obj.data.vertices)).max(), 0.005)

    def test_a_handle_at_rest_leaves_every_bit(self):
        obj = wavy(PLACES["turned and moved"])
        rest = coordinates(obj.data.vertices)
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.respond()
        bpy.ops.lapwing.apply()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)

    def test_nothing_moves_outside_the_region(self):
        obj = wavy(PLACES["of negative scale"])
        rest = coordinates(obj.data.vertices)
        deform(obj)
        made = coordinates(obj.data.vertices)
        outside = np.hypot(rest[:, 0], rest[:, 1]) >= 0.8
        np.testing.assert_array_equal(made[outside], rest[outside])
        self.assertTrue((made != rest)[~outside].any())

    def test_a_shape_key_leaves_the_mesh_and_returns_the_handle(self):
        obj = wavy()
        rest, place = coordinates(obj.data.vertices), scene.empty_of(obj).matrix_world.copy()
        deform(obj, as_key=True, key_name="Lifted")
        keys = obj.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in keys], ["Basis", "Lifted"])
        np.testing.assert_array_equal(coordinates(keys["Basis"].data), rest)
        np.testing.assert_allclose(np.array(scene.empty_of(obj).matrix_world), np.array(place), atol=1e-6)
        self.assertNotIn("lapwing_rest", obj.data.attributes)

    def test_an_edit_in_the_mesh_moves_its_shape_keys_along(self):
        obj = wavy()
        obj.shape_key_add(name="Basis")
        smile = obj.shape_key_add(name="Smile")
        smile.data[0].co.z += 0.25
        deform(obj)
        keys = obj.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in keys], ["Basis", "Smile"])
        change = coordinates(keys["Smile"].data) - coordinates(keys["Basis"].data)
        self.assertAlmostEqual(change[0, 2], 0.25, places=6)
        self.assertLess(np.abs(change[1:]).max(), 1e-6)

    def test_cancelling_brings_every_bit_back(self):
        obj = wavy()
        rest = coordinates(obj.data.vertices)
        bpy.ops.lapwing.start()
        move(obj, lift())
        bpy.ops.lapwing.settle()
        bpy.ops.lapwing.cancel()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)
        self.assertFalse(obj.lapwing.is_live)

    def test_undo_takes_the_surface_back_with_the_handle(self):
        obj = wavy()
        bpy.ops.lapwing.start()
        bpy.ops.ed.undo_push(message="start")
        rest = coordinates(obj.data.vertices)
        move(obj, lift())
        bpy.ops.lapwing.respond()
        bpy.ops.ed.undo_push(message="move")
        self.assertGreater(np.abs(coordinates(obj.data.vertices) - rest).max(), 0.1)
        bpy.ops.ed.undo()
        obj = bpy.data.objects["Wavy"]
        bpy.ops.lapwing.respond()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)

    def test_undo_of_an_applied_edit_brings_the_mesh_back(self):
        obj = wavy()
        rest = coordinates(obj.data.vertices)
        bpy.ops.ed.undo_push(message="before")
        deform(obj)
        bpy.ops.ed.undo_push(message="applied")
        bpy.ops.ed.undo()
        obj = bpy.data.objects["Wavy"]
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)
        self.assertFalse(obj.lapwing.is_live)
        self.assertNotIn("lapwing_edits", obj)

    def test_a_saved_live_edit_goes_on_after_opening(self):
        obj = wavy()
        bpy.ops.lapwing.start()
        move(obj, lift())
        bpy.ops.lapwing.settle()
        settled = coordinates(obj.data.vertices)
        path = str(scene.WORK / "live.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
        obj = bpy.data.objects["Wavy"]
        scene.make_active(obj)
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.settle()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), settled)

    def test_an_object_that_moves_takes_its_edit_along(self):
        obj = wavy()
        drag(obj)
        before = coordinates(obj.data.vertices)
        by = Matrix.Translation((4, 0, 0)) @ Matrix.Rotation(0.5, 4, "Z")
        obj.matrix_world = by @ obj.matrix_world
        move(obj, by)
        bpy.ops.lapwing.respond()
        self.assertLess(np.abs(coordinates(obj.data.vertices) - before).max(), 2e-6)

    def test_the_active_empty_stands_for_its_mesh(self):
        obj = wavy()
        bpy.ops.lapwing.start()
        scene.make_active(scene.empty_of(obj))
        move(obj, lift())
        bpy.ops.lapwing.apply()
        self.assertGreater(coordinates(obj.data.vertices)[:, 2].max(), 0.3)

    def test_a_mesh_that_gets_shape_keys_meanwhile_ends_the_edit(self):
        from lapwing_blender import session
        obj = wavy()
        drag(obj)
        obj.shape_key_add(name="Basis")
        shown = coordinates(obj.data.shape_keys.key_blocks["Basis"].data)
        session.advance(obj, session.session_of(obj))
        self.assertFalse(obj.lapwing.is_live)
        self.assertIn("shape keys", session.why_ended(obj))
        np.testing.assert_array_equal(coordinates(obj.data.shape_keys.key_blocks["Basis"].data), shown)


class Settings(SceneTest):
    def step(self, obj):
        move(obj, lift())
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.apply(as_key=True)
        return json.loads(obj["lapwing_edits"])[-1]["steps"][0]

    def test_x_symmetry_mirrors_the_edit(self):
        vertices, faces = scene.grid(24, lambda x, y: 0.03 * np.cos(6 * x) * np.cos(5 * y))
        obj = scene.add_mesh("Face", vertices, faces, PLACES["turned and moved"])
        scene.select(obj, np.abs(vertices[:, 1]) < 0.9)
        bpy.ops.lapwing.set_region()
        scene.select(obj, np.hypot(vertices[:, 0] - 0.5, vertices[:, 1]) < 0.15)
        bpy.ops.lapwing.add_handle()
        obj.data.use_mirror_x = True
        obj.lapwing.belt_fraction = 0.2
        bpy.ops.lapwing.start()
        move(obj, Matrix.Translation(obj.matrix_world.to_3x3() @ Matrix.Translation((0, 0, 0.3)).translation))
        bpy.ops.lapwing.settle()
        z = coordinates(obj.data.vertices)[:, 2].reshape(25, 25)
        self.assertGreater(z.max(), 0.25)
        self.assertLess(np.abs(z - z[::-1]).max(), 0.005)  # quads are halved one way

    def test_proportional_editing_gives_a_new_handle_its_falloff(self):
        obj = wavy()
        tools = bpy.context.tool_settings
        tools.use_proportional_edit_objects = True
        tools.proportional_size = 0.3
        tools.proportional_edit_falloff = "LINEAR"
        obj.lapwing.handles.clear()
        bpy.ops.lapwing.add_handle()
        self.assertEqual(self.step(obj)["handles"][0]["falloff"]["profile"], "linear")
        self.assertAlmostEqual(obj.lapwing.handles[0].falloff, 0.3, places=6)

    def test_painted_weights_hold_by_that_much(self):
        obj = wavy()
        group = obj.vertex_groups[obj.lapwing.handles[0].group]
        held = [v.index for v in obj.data.vertices if any(g.group == group.index for g in v.groups)]
        group.add(held[:3], 0.5, "REPLACE")
        field = self.step(obj)["handles"][0]["weight"]["field"]
        self.assertEqual([field[v] for v in held[:4]], [0.5, 0.5, 0.5, 1.0])

    def test_an_empty_rests_where_it_is_when_it_is_chosen(self):
        obj = wavy(PLACES["of uneven scale"])
        rest = coordinates(obj.data.vertices)
        other = bpy.data.objects.new("Other", None)
        bpy.context.scene.collection.objects.link(other)
        other.matrix_world = lift()
        bpy.context.view_layer.update()
        obj.lapwing.handles[0].empty = other
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.settle()
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)
        move(obj, lift())
        bpy.ops.lapwing.settle()
        self.assertGreater(np.abs(coordinates(obj.data.vertices) - rest).max(), 0.1)

    def test_pins_stay(self):
        obj = wavy()
        rest = coordinates(obj.data.vertices)
        pinned = np.hypot(rest[:, 0] - 0.4, rest[:, 1]) < 0.1
        scene.select(obj, pinned)
        bpy.ops.lapwing.set_region(role="pins")
        obj.lapwing.hard = True
        deform(obj)
        moved = np.linalg.norm(coordinates(obj.data.vertices) - rest, axis=1)
        self.assertLess(moved[pinned].max(), 1e-6)
        self.assertGreater(moved.max(), 0.3)

    def test_the_sculpt_mask_is_a_region(self):
        obj = wavy()
        # Without a window nothing can be painted; a Multires modifier brings a mask of 0 along.
        bpy.ops.object.mode_set(mode="SCULPT")
        obj.modifiers.new("Multires", "MULTIRES")
        bpy.ops.object.mode_set(mode="OBJECT")
        obj.data.vertex_paint_masks[0].data.foreach_set("value", np.ones(len(obj.data.vertices), "f"))
        bpy.ops.lapwing.set_region(source="MASK")
        self.assertEqual(self.step(obj)["roi"], {"all": True})

    def test_the_selection_of_edit_mode_is_a_region(self):
        obj = wavy()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.lapwing.set_region()
        self.assertEqual(obj.mode, "EDIT")
        bpy.ops.lapwing.start()
        self.assertEqual(obj.mode, "OBJECT")
        self.assertEqual(self.step(obj)["roi"], {"all": True})


class AwkwardMeshes(SceneTest):
    def test_a_non_manifold_mesh_is_edited(self):
        vertices, faces = scene.grid(12, lambda x, y: 0 * x)
        fin = len(vertices)
        vertices = np.vstack([vertices, [[0, 0, 0.3], [0, 1 / 6, 0.3]]])
        obj = scene.add_mesh("Fin", vertices, faces + [[84, 85, fin + 1, fin]])
        scene.select(obj, np.ones(len(vertices), bool))
        bpy.ops.lapwing.set_region()
        scene.select(obj, np.arange(len(vertices)) == fin)
        bpy.ops.lapwing.add_handle()
        deform(obj, Matrix.Translation((0, 0, 0.2)))
        self.assertGreater(coordinates(obj.data.vertices)[fin, 2], 0.4)

    def test_modifiers_go_on_working_on_what_is_edited(self):
        obj = wavy()
        obj.modifiers.new("Subdivision", "SUBSURF")
        bpy.ops.lapwing.start()
        move(obj, lift())
        bpy.ops.lapwing.settle()
        shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
        self.assertGreater(len(shown.vertices), 2 * len(obj.data.vertices))
        self.assertGreater(max(v.co.z for v in shown.vertices), 0.3)
        bpy.ops.lapwing.apply()
        self.assertEqual([m.type for m in obj.modifiers], ["SUBSURF"])


scene.main()
