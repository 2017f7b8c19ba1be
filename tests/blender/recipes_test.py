"""Recipes kept on objects: replayed, saved, exported."""

import json

import bpy
import numpy as np
from mathutils import Matrix, Vector
import scene
from scene import SceneTest, coordinates, deform, diagonal, export, in_world, make_active, run_recipe, wavy


#: Somewhere else, of another size.
PLACE = Matrix.Translation((5, 1, 0)) @ Matrix.Rotation(1.0, 4, "Y") @ Matrix.Scale(3.0, 4)


def copy_of(obj, original, matrix):
    """An object with the mesh that `obj` had at first."""
    other = bpy.data.objects.new("Copy", original)
    bpy.context.scene.collection.objects.link(other)
    other.matrix_world = matrix
    make_active(other, obj)
    bpy.context.view_layer.update()
    return other


class Replay(SceneTest):
    def test_on_a_copy_elsewhere_the_surface_is_the_same_there(self):
        obj = wavy(Matrix.Translation((1, 2, 3)))
        original = obj.data.copy()
        deform(obj)
        place = Matrix.Translation((-7, 0, 1)) @ Matrix.Rotation(2.0, 4, (1, 1, 0)) @ Matrix.Scale(3.0, 4)
        other = copy_of(obj, original, place)
        bpy.ops.lapwing.replay()
        made, expected = coordinates(other.data.vertices), coordinates(obj.data.vertices)
        self.assertLess(np.abs(made - expected).max(), 2e-6 * diagonal(expected))

    def test_lengths_and_symmetry_go_along(self):
        obj = wavy()
        obj.lapwing.handles[0].falloff = 0.3
        obj.data.use_mirror_x = True
        original = obj.data.copy()
        deform(obj, Matrix.Translation((0, 0.1, 0.3)))
        turned = Matrix.Translation((5, 0, 0)) @ Matrix.Rotation(1.0, 4, "Y")
        other = copy_of(obj, original, turned @ Matrix.Scale(0.5, 4))
        bpy.ops.lapwing.replay()
        made, expected = coordinates(other.data.vertices), coordinates(obj.data.vertices)
        # Settling ends within 1e-4 of an edge; a length that stayed would show in every one.
        self.assertLess(np.abs(made - expected).max(), 2e-5 * diagonal(expected))

    def test_the_detail_size_of_a_peel_goes_along(self):
        obj = wavy()
        original, rest = obj.data.copy(), coordinates(obj.data.vertices)
        bpy.context.scene.cursor.location = (0.1, 0, 0)
        bpy.ops.lapwing.peel(region="CURSOR", radius=0.7, detail_size=0.5)
        other = copy_of(obj, original, PLACE)
        bpy.ops.lapwing.replay()
        made, expected = coordinates(other.data.vertices), coordinates(obj.data.vertices)
        self.assertGreater(np.abs(made - rest).max(), 0.01)
        self.assertLess(np.abs(made - expected).max(), 2e-6 * diagonal(expected))

    def test_of_a_mix_the_mesh_s_own_detail_goes_along_and_the_source_s_does_not(self):
        scene.add_mesh("Source", *scene.grid(12, lambda x, y: 0.03 * np.sin(9 * x)))
        obj = scene.add_mesh("Target", *scene.grid(24, lambda x, y: 0.05 * np.sin(9 * x)))
        original = obj.data.copy()
        bpy.context.scene.cursor.location = (0.1, 0, 0)
        bpy.ops.lapwing.mix(region="CURSOR", radius=0.7, source="Source", detail_size=0.7,
                            own_detail_size=0.5)
        other = copy_of(obj, original, PLACE)
        bpy.ops.lapwing.replay()
        step = json.loads(other["lapwing_edits"])[0]["steps"][0]
        source, own = step["sources"]
        self.assertAlmostEqual(source["detail_size"], 0.7, places=6)
        self.assertAlmostEqual(own["detail_size"], 3 * 0.5, places=6)
        self.assertEqual(own["patch"], step["target_patch"])
        near = own["patch"]["disk_in"]["disk"]["near"]
        np.testing.assert_allclose(near, PLACE @ Vector((0.1, 0, 0)), atol=1e-6)

    def test_as_a_shape_key(self):
        obj = wavy()
        original = obj.data.copy()
        deform(obj)
        other = copy_of(obj, original, Matrix.Identity(4))
        bpy.ops.lapwing.replay(as_key=True, key_name="Again")
        key = other.data.shape_keys.key_blocks["Again"]
        self.assertLess(np.abs(coordinates(key.data) - coordinates(obj.data.vertices)).max(), 1e-6)

    def test_what_was_replayed_can_be_replayed(self):
        obj = wavy()
        original = obj.data.copy()
        deform(obj)
        other = copy_of(obj, original.copy(), Matrix.Translation((3, 0, 0)))
        bpy.ops.lapwing.replay()
        third = copy_of(other, original, Matrix.Translation((0, 3, 0)))
        bpy.ops.lapwing.replay()
        self.assertLess(np.abs(coordinates(third.data.vertices) - coordinates(obj.data.vertices)).max(), 1e-6)

    def test_after_saving_and_opening(self):
        obj = wavy()
        deform(obj)
        expected = coordinates(obj.data.vertices)
        path = str(scene.WORK / "saved.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.read_homefile(use_empty=True)
        bpy.ops.wm.open_mainfile(filepath=path)
        obj = bpy.data.objects["Wavy"]
        np.testing.assert_array_equal(coordinates(obj.data.vertices), expected)
        other = copy_of(obj, obj.lapwing.original.copy(), Matrix.Identity(4))
        bpy.ops.lapwing.replay()
        np.testing.assert_allclose(coordinates(other.data.vertices), expected, atol=1e-6)


class Export(SceneTest):
    def test_two_edits_in_a_row_and_a_shape_key_on_them(self):
        obj = wavy(Matrix.Translation((2, 0, 0)) @ Matrix.Scale(2.0, 4))
        deform(obj)
        obj.matrix_world = Matrix.Translation((0, 9, 0)) @ obj.matrix_world
        scene.empty_of(obj).matrix_world = Matrix.Translation((0, 9, 0)) @ scene.empty_of(obj).matrix_world
        bpy.context.view_layer.update()
        deform(obj, Matrix.Translation((0.2, 0, -0.3)))
        deform(obj, Matrix.Translation((0, 0.3, 0)), as_key=True)
        deform(obj, Matrix.Translation((0, -0.3, 0)), as_key=True)
        recipe = export()
        self.assertEqual(len(json.loads(recipe.read_text())["steps"]), 3)
        # In the world in which the first edit was made.
        expected = run_recipe(recipe) + [0, 9, 0]
        made = in_world(obj, coordinates(obj.data.shape_keys.key_blocks["Lapwing.001"].data))
        self.assertLess(np.abs(made - expected).max(), 1e-6 * diagonal(expected))

    def test_up_to_an_edit(self):
        obj = wavy()
        deform(obj)
        after_one = coordinates(obj.data.vertices)
        deform(obj)
        made = run_recipe(export(edit=0))
        self.assertLess(np.abs(made - after_one).max(), 1e-6 * diagonal(made))

    def test_a_coat_with_its_source(self):
        bumps = scene.grid(20, lambda x, y: 0.03 * np.sin(15 * x))
        source = scene.add_mesh("Source", *bumps, Matrix.Translation((9, 0, 0)))
        obj = scene.add_mesh("Target", *scene.grid(24, lambda x, y: 0.1 * y * y, mixed=True))
        make_active(obj, source)
        bpy.ops.lapwing.coat(region="CURSOR", radius=0.7, detail_size=0.3)
        made = run_recipe(export())
        np.testing.assert_allclose(in_world(obj, coordinates(obj.data.vertices)), made, atol=1e-6)

    def test_a_peel_between_two_edits(self):
        obj = wavy(Matrix.Translation((2, 0, 0)))
        deform(obj)
        bpy.ops.lapwing.peel(region="GROUP", group="Lapwing Region", detail_size=0.4)
        deform(obj, Matrix.Translation((0, 0, 0.1)))
        recipe = export()
        ops = [step["op"] for step in json.loads(recipe.read_text())["steps"]]
        self.assertEqual(ops, ["deform", "peel", "deform"])
        made = in_world(obj, coordinates(obj.data.vertices))
        self.assertLess(np.abs(run_recipe(recipe) - made).max(), 1e-6 * diagonal(made))

    def test_forgetting_frees_the_original(self):
        obj = wavy()
        deform(obj)
        self.assertEqual(len(bpy.data.meshes), 2)
        bpy.ops.lapwing.forget_recipe()
        self.assertEqual(len(bpy.data.meshes), 1)
        self.assertNotIn("lapwing_edits", obj)


scene.main()
