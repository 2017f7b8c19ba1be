"""Impossible edits are refused in one sentence, in Blender's own report."""

import os
import sys
import types
from unittest import mock

import blf
import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import SceneTest, wavy


def start_is_refused(words):
    """Returns a decorator that makes a test of a function that spoils an edit."""
    def decorate(spoil):
        def test(self):
            obj = wavy()
            spoil(self, obj)
            bpy.context.view_layer.update()
            self.assert_refused(words, bpy.ops.lapwing.start)
            self.assertFalse(obj.lapwing.is_live)

        return test

    return decorate


class Edits(SceneTest):
    @start_is_refused("The region is not set")
    def test_without_a_region(self, obj):
        obj.lapwing.roi = ""

    @start_is_refused("There is no handle")
    def test_without_a_handle(self, obj):
        obj.lapwing.handles.clear()

    @start_is_refused("leaves the region at vertex 0")
    def test_a_handle_outside_the_region(self, obj):
        obj.vertex_groups[obj.lapwing.handles[0].group].add([0], 1.0, "REPLACE")

    @start_is_refused("'Nowhere', which 'Wavy' does not have")
    def test_a_belt_that_is_missing(self, obj):
        obj.lapwing.belt = "Nowhere"

    @start_is_refused("none of whose vertices is in the region")
    def test_a_belt_outside_the_region(self, obj):
        obj.vertex_groups.new(name="Away").add([0], 1.0, "REPLACE")
        obj.lapwing.belt = "Away"

    @start_is_refused("which is empty")
    def test_an_empty_region(self, obj):
        obj.vertex_groups.new(name="Nothing")
        obj.lapwing.roi = "Nothing"

    @start_is_refused("is gone")
    def test_an_empty_that_is_gone(self, obj):
        bpy.data.objects.remove(scene.empty_of(obj))

    @start_is_refused("scaled to nothing")
    def test_an_object_scaled_to_nothing(self, obj):
        obj.matrix_world = Matrix.Diagonal((1, 1, 0, 1))

    @start_is_refused("is sheared")
    def test_symmetry_of_a_sheared_object(self, obj):
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(parent)
        parent.matrix_world = Matrix.Diagonal((3, 1, 1, 1))
        obj.parent = parent
        obj.rotation_euler = (0, 0, 0.7)
        obj.data.use_mirror_x = True

    @start_is_refused("has no faces")
    def test_a_mesh_without_faces(self, obj):
        obj.data.clear_geometry()
        obj.data.vertices.add(3)
        for name in (obj.lapwing.roi, obj.lapwing.handles[0].group):  # they went with the geometry
            obj.vertex_groups.new(name=name).add([0], 1.0, "REPLACE")

    def test_an_empty_selection(self):
        obj = wavy()
        scene.select(obj, np.zeros(len(obj.data.vertices)))
        self.assert_refused("Nothing is selected", bpy.ops.lapwing.set_region)
        self.assert_refused("Nothing is selected", bpy.ops.lapwing.add_handle)

    def test_linked_data(self):
        wavy()
        path = str(scene.WORK / "library.blend")
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.read_homefile(use_empty=True)
        with bpy.data.libraries.load(path, link=True) as (_, to):
            to.objects = ["Wavy"]
        obj = bpy.data.objects["Wavy"]
        bpy.context.scene.collection.objects.link(obj)
        scene.make_active(obj)
        self.assert_refused("make it local", bpy.ops.lapwing.start)

    def test_what_the_engine_refuses_comes_in_its_words(self):
        obj = wavy()
        obj.lapwing.belt = obj.lapwing.handles[0].group
        for engine in (scene.MODULE, scene.CLI):
            with self.subTest(engine):
                scene.use_engine(engine)
                self.assert_refused("belt", bpy.ops.lapwing.start)
        self.assertFalse(obj.lapwing.is_live)


class Surfaces(SceneTest):
    def pair(self):
        source = scene.add_mesh("Source", *scene.grid(20, lambda x, y: 0.02 * np.sin(20 * x)))
        target = scene.add_mesh("Target", *scene.grid(20, lambda x, y: 0 * x))
        scene.make_active(target, source)
        return target, source

    def test_without_a_source(self):
        target, _ = self.pair()
        scene.make_active(target)
        for operator in (bpy.ops.lapwing.coat, bpy.ops.lapwing.transplant, bpy.ops.lapwing.replay):
            self.assert_refused("select one other mesh object", operator)

    def test_without_a_selection(self):
        target, _ = self.pair()
        scene.select(target, np.zeros(len(target.data.vertices)))
        self.assert_refused("select faces of it", bpy.ops.lapwing.coat, region="SELECTION")

    def test_a_detail_size_of_nothing(self):
        self.pair()
        self.assert_refused("The detail size is 0", bpy.ops.lapwing.coat, region="CURSOR", detail_size=0.0)

    def test_new_faces_for_shape_keys_or_multires(self):
        target, _ = self.pair()
        vertices = len(target.data.vertices)
        target.shape_key_add(name="Basis")
        where = dict(region="CURSOR", radius=0.5, detail_size=0.1)
        self.assert_refused("has shape keys", bpy.ops.lapwing.coat, **where)
        target.shape_key_clear()
        target.modifiers.new("Multires", "MULTIRES")
        self.assert_refused("has a Multires modifier", bpy.ops.lapwing.coat, **where)
        self.assertEqual(len(target.data.vertices), vertices)
        self.assertIsNone(target.lapwing.original)

    def test_a_part_a_hundred_times_as_large(self):
        _, part = self.pair()
        part.scale = (100, 100, 100)
        bpy.context.view_layer.update()
        self.assert_refused(
            "Error: The seam between mesh and part would get", bpy.ops.lapwing.transplant,
            region="CURSOR", radius=0.3, place="WORLD",
        )

    def test_detail_larger_than_its_source_leaves_the_target(self):
        target, source = self.pair()
        source.scale = (1e-3, 1e-3, 1e-3)
        bpy.context.view_layer.update()
        bpy.ops.lapwing.coat(region="CURSOR", radius=0.5, detail_size=0.1)
        self.assertLess(max(abs(v.co.z) for v in target.data.vertices), 1e-3)

    def test_a_recipe_for_other_vertices(self):
        obj = wavy()
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.apply()
        other = scene.add_mesh("Other", *scene.grid(5, lambda x, y: 0 * x))
        scene.make_active(other, obj)
        self.assert_refused("replay it on a mesh with the same vertices", bpy.ops.lapwing.replay)

    def test_an_object_without_a_recipe(self):
        target, source = self.pair()
        self.assert_refused("has no recipe", bpy.ops.lapwing.replay)
        self.assert_refused("has no recipe", bpy.ops.lapwing.export_recipe,
                            filepath=str(scene.WORK / "none.json"))

    def test_a_recipe_whose_source_is_gone(self):
        target, source = self.pair()
        bpy.ops.lapwing.coat(region="CURSOR", radius=0.5, detail_size=0.3)
        bpy.data.objects.remove(source)
        self.assert_refused("needs the mesh object 'Source'", bpy.ops.lapwing.export_recipe,
                            filepath=str(scene.WORK / "gone.json"))

    def test_a_folder_that_is_not_there(self):
        wavy()
        bpy.ops.lapwing.start()
        bpy.ops.lapwing.apply()
        self.assert_refused("cannot be written", bpy.ops.lapwing.export_recipe,
                            filepath=str(scene.WORK / "nowhere" / "recipe.json"))

    def test_frames_in_the_wrong_order(self):
        wavy()
        self.assert_refused("is before the first", bpy.ops.lapwing.bake, first=5, last=4)

    def test_a_cache_without_a_place(self):
        wavy()
        self.assert_refused("has no place yet", bpy.ops.lapwing.bake, first=1, last=2, kind="PC2")


class Engines(SceneTest):
    def setUp(self):
        super().setUp()
        # Simulate a Blender that has not loaded the engine and cannot find it.
        modules = mock.patch.dict(sys.modules)
        modules.start()
        self.addCleanup(modules.stop)
        for name in [name for name in sys.modules if name.split(".")[0] == "lapwing"]:
            del sys.modules[name]
        path = mock.patch.dict(os.environ, {"PATH": ""})
        path.start()
        self.addCleanup(path.stop)

    def use_program(self, name, text):
        folder = scene.WORK / name
        folder.mkdir()
        (folder / "lapwing").write_text(text)
        if text.startswith("#!"):
            (folder / "lapwing").chmod(0o755)
        scene.use_engine(folder / "lapwing")

    def use_module(self, name, text):
        package = scene.WORK / name / "lapwing"
        package.mkdir(parents=True)
        (package / "__init__.py").write_text(text)
        scene.use_engine(package.parent)

    @start_is_refused("There is no engine at")
    def test_a_path_that_is_not_there(self, _obj):
        scene.use_engine(scene.WORK / "nowhere")

    @start_is_refused("holds no folder 'lapwing'")
    def test_a_folder_without_an_engine(self, _obj):
        (scene.WORK / "empty").mkdir()
        scene.use_engine(scene.WORK / "empty")

    @start_is_refused("is of version 9.3.1, and this add-on needs 0.1")
    def test_a_program_of_another_version(self, _obj):
        self.use_program("other", "#!/bin/sh\necho 9.3.1\n")

    @start_is_refused("is of version 0.2.0, and this add-on needs 0.1")
    def test_a_module_of_another_version(self, _obj):
        self.use_module("old", "__version__ = '0.2.0'\nclass Deformer: pass\n")

    @start_is_refused("is of version unknown")
    def test_a_program_that_is_no_lapwing(self, _obj):
        self.use_program("wrong", "#!/bin/sh\nexit 1\n")

    @start_is_refused("cannot be started")
    def test_a_file_that_is_no_program(self, _obj):
        self.use_program("text", "no program")

    @start_is_refused("built for Python 3.9")
    def test_a_module_that_cannot_be_imported(self, _obj):
        self.use_module("broken", "raise ImportError('built for Python 3.9')\n")

    @start_is_refused("engine was not found")
    def test_no_engine_at_all(self, _obj):
        scene.use_engine("")


class PanelText(SceneTest):
    """Text in the panels has as many lines as its width needs."""

    WARNING = ("14 triangles are flipped, the first 1093. Move the handle less, rotate it with its motion, "
               "or use several steps, or enlarge the region.")

    def lines(self, text, width):
        """Returns the labels that a region of `width` pixels gets."""
        from lapwing_blender.wrapped_text import draw_text

        column = mock.Mock()
        layout = mock.Mock()
        layout.column.return_value = column
        preferences = types.SimpleNamespace(  # without a window, Blender's scale is 0
            system=types.SimpleNamespace(ui_scale=1.0), ui_styles=bpy.context.preferences.ui_styles)
        context = types.SimpleNamespace(
            region=types.SimpleNamespace(width=width), preferences=preferences)
        draw_text(layout, context, text, icon="ERROR")
        return [call.kwargs["text"] for call in column.label.call_args_list]

    def test_no_line_is_wider_than_the_region_and_no_word_is_lost(self):
        for width in (180, 300, 900):
            with self.subTest(width):
                lines = self.lines(self.WARNING, width)
                self.assertEqual(" ".join(lines), self.WARNING)
                self.assertLess(max(blf.dimensions(0, line)[0] for line in lines), width)
        self.assertGreater(len(self.lines(self.WARNING, 180)), len(self.lines(self.WARNING, 300)))
        self.assertEqual(self.lines(self.WARNING, 5000), [self.WARNING])

    def test_a_path_continues_on_the_next_line(self):
        path = "/home/someone/projects/a-very-long-name-of-a-folder/and-another-one/mesh.ply"
        lines = self.lines(path, 200)
        self.assertGreater(len(lines), 1)
        self.assertEqual("".join(lines), path)

    def test_a_region_without_width_still_shows_every_letter(self):
        self.assertEqual("".join(self.lines("no room", 0)), "noroom")
        self.assertEqual(self.lines("", 300), [])


scene.main()
