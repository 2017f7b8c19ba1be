"""What cannot be done is refused in one sentence, in Blender's own report."""

import os
import sys
from unittest import mock

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import SceneTest, wavy


class Edits(SceneTest):
    def test_without_a_region(self):
        obj = wavy()
        obj.lapwing.roi = ""
        self.assert_refused("The region is not set", bpy.ops.lapwing.start)

    def test_without_a_handle(self):
        obj = wavy()
        obj.lapwing.handles.clear()
        self.assert_refused("There is no handle", bpy.ops.lapwing.start)

    def test_a_handle_outside_the_region(self):
        obj = wavy()
        obj.vertex_groups[obj.lapwing.handles[0].group].add([0], 1.0, "REPLACE")
        self.assert_refused("leaves the region at vertex 0", bpy.ops.lapwing.start)

    def test_a_belt_that_is_missing(self):
        obj = wavy()
        obj.lapwing.belt = "Nowhere"
        self.assert_refused("'Nowhere', which 'Wavy' does not have", bpy.ops.lapwing.start)

    def test_a_belt_outside_the_region(self):
        obj = wavy()
        obj.vertex_groups.new(name="Away").add([0], 1.0, "REPLACE")
        obj.lapwing.belt = "Away"
        self.assert_refused("none of whose vertices is in the region", bpy.ops.lapwing.start)

    def test_an_empty_region(self):
        obj = wavy()
        obj.vertex_groups.new(name="Nothing")
        obj.lapwing.roi = "Nothing"
        self.assert_refused("which is empty", bpy.ops.lapwing.start)

    def test_an_empty_selection(self):
        obj = wavy()
        scene.select(obj, np.zeros(len(obj.data.vertices)))
        self.assert_refused("Nothing is selected", bpy.ops.lapwing.set_region)
        self.assert_refused("Nothing is selected", bpy.ops.lapwing.add_handle)

    def test_an_empty_that_is_gone(self):
        obj = wavy()
        bpy.data.objects.remove(scene.empty_of(obj))
        self.assert_refused("is gone", bpy.ops.lapwing.start)
        self.assertFalse(obj.lapwing.is_live)

    def test_an_object_scaled_to_nothing(self):
        wavy().matrix_world = Matrix.Diagonal((1, 1, 0, 1))
        bpy.context.view_layer.update()
        self.assert_refused("scaled to nothing", bpy.ops.lapwing.start)

    def test_symmetry_of_a_sheared_object(self):
        obj = wavy()
        parent = bpy.data.objects.new("Parent", None)
        bpy.context.scene.collection.objects.link(parent)
        parent.matrix_world = Matrix.Diagonal((3, 1, 1, 1))
        obj.parent = parent
        obj.rotation_euler = (0, 0, 0.7)
        obj.data.use_mirror_x = True
        bpy.context.view_layer.update()
        self.assert_refused("is sheared", bpy.ops.lapwing.start)

    def test_a_mesh_without_faces(self):
        obj = wavy()
        obj.data.clear_geometry()
        obj.data.vertices.add(3)
        for name in (obj.lapwing.roi, obj.lapwing.handles[0].group):  # they went with the geometry
            obj.vertex_groups.new(name=name).add([0], 1.0, "REPLACE")
        self.assert_refused("has no faces", bpy.ops.lapwing.start)

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
        self.assert_refused("select one other mesh object", bpy.ops.lapwing.coat, region="CURSOR")
        self.assert_refused("select one other mesh object", bpy.ops.lapwing.transplant, region="CURSOR")
        self.assert_refused("select one other mesh object", bpy.ops.lapwing.replay)

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
        # As in a Blender that has not loaded the engine yet, and finds none by itself.
        modules = mock.patch.dict(sys.modules)
        modules.start()
        self.addCleanup(modules.stop)
        for name in [name for name in sys.modules if name.split(".")[0] == "lapwing"]:
            del sys.modules[name]
        path = mock.patch.dict(os.environ, {"PATH": ""})
        path.start()
        self.addCleanup(path.stop)

    def folder(self, name):
        folder = scene.WORK / name
        folder.mkdir(exist_ok=True)
        return folder

    def program(self, name, script):
        program = self.folder(name) / "lapwing"
        program.write_text("#!/bin/sh\n" + script)
        program.chmod(0o755)
        return program

    def test_a_path_that_is_not_there(self):
        wavy()
        scene.use_engine(scene.WORK / "nowhere")
        self.assert_refused("There is no engine at", bpy.ops.lapwing.start)

    def test_a_folder_without_an_engine(self):
        wavy()
        scene.use_engine(self.folder("empty"))
        self.assert_refused("holds no folder 'lapwing'", bpy.ops.lapwing.start)

    def test_a_program_of_another_version(self):
        wavy()
        scene.use_engine(self.program("other", "echo 9.3.1\n"))
        self.assert_refused("is of version 9.3.1, and this add-on needs 0.1", bpy.ops.lapwing.start)

    def test_a_module_of_another_version(self):
        package = self.folder("old") / "lapwing"
        package.mkdir()
        (package / "__init__.py").write_text("__version__ = '0.2.0'\nclass Deformer: pass\n")
        wavy()
        scene.use_engine(package.parent)
        self.assert_refused("is of version 0.2.0, and this add-on needs 0.1", bpy.ops.lapwing.start)

    def test_a_program_that_is_no_lapwing(self):
        wavy()
        scene.use_engine(self.program("wrong", "exit 1\n"))
        self.assert_refused("is of version unknown", bpy.ops.lapwing.start)

    def test_a_file_that_is_no_program(self):
        wavy()
        file = self.folder("text") / "lapwing"
        file.write_text("no program")
        scene.use_engine(file)
        self.assert_refused("cannot be started", bpy.ops.lapwing.start)

    def test_a_module_that_cannot_be_imported(self):
        package = self.folder("broken") / "lapwing"
        package.mkdir()
        (package / "__init__.py").write_text("raise ImportError('built for Python 3.9')\n")
        wavy()
        scene.use_engine(package.parent)
        self.assert_refused("built for Python 3.9", bpy.ops.lapwing.start)

    def test_no_engine_at_all(self):
        wavy()
        scene.use_engine("")
        self.assert_refused("engine was not found", bpy.ops.lapwing.start)


scene.main()
