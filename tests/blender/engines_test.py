"""The engine as a module of Python, and as a program."""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(__file__))

import bpy
import numpy as np
import scene
from scene import SceneTest, coordinates, lift, move, wavy


def edited(engine, operation):
    """The vertices and faces that an operation leaves with this engine."""
    bpy.ops.wm.read_homefile(use_empty=True)
    scene.use_engine(engine)
    obj = operation()
    sizes = [len(polygon.vertices) for polygon in obj.data.polygons]
    return coordinates(obj.data.vertices), sizes


def deformed():
    obj = wavy()
    bpy.ops.lapwing.start()
    move(obj, lift())
    bpy.ops.lapwing.respond()
    bpy.ops.lapwing.apply()
    return obj


def dragged():
    obj = wavy()
    bpy.ops.lapwing.start()
    move(obj, lift())
    bpy.ops.lapwing.respond()
    return obj


def coated():
    source = scene.add_mesh("Source", *scene.grid(30, lambda x, y: 0.03 * np.sin(20 * x) * np.sin(20 * y)))
    obj = scene.add_mesh("Target", *scene.grid(10, lambda x, y: 0.1 * x * x, mixed=True))
    scene.make_active(obj, source)
    bpy.ops.lapwing.coat(region="CURSOR", radius=0.7, detail_size=0.3)
    return obj


def peeled():
    obj = wavy()
    bpy.ops.lapwing.peel(region="GROUP", group="Lapwing Region", detail_size=1.0)
    return obj


class BothEngines(SceneTest):
    def test_they_agree(self):
        for operation in (deformed, dragged, coated, peeled):
            with self.subTest(operation.__name__):
                by_module, faces = edited(scene.MODULE, operation)
                by_program, program_faces = edited(scene.CLI, operation)
                self.assertEqual(faces, program_faces)
                np.testing.assert_allclose(by_program, by_module, atol=1e-6)

    def test_the_program_leaves_no_files(self):
        import tempfile
        scene.use_engine(scene.CLI)
        obj = wavy()
        folder = tempfile.gettempdir()
        before = {name for name in os.listdir(folder) if name.startswith("lapwing-")}
        bpy.ops.lapwing.start()
        move(obj, lift())
        bpy.ops.lapwing.apply()
        left = {name for name in os.listdir(folder) if name.startswith("lapwing-")} - before
        self.assertEqual(left, set())

    def test_what_the_program_refuses_comes_in_its_words(self):
        scene.use_engine(scene.CLI)
        obj = wavy()
        obj.lapwing.belt = obj.lapwing.handles[0].group
        self.assert_refused("belt", bpy.ops.lapwing.start)

    def test_the_add_on_has_the_engine_s_version(self):
        import lapwing_blender
        said = subprocess.run([scene.CLI, "--version"], capture_output=True, text=True, check=True)
        version = ".".join(map(str, lapwing_blender.bl_info["version"]))
        self.assertEqual(said.stdout.split()[-1], version)
        manifest = os.path.join(os.path.dirname(lapwing_blender.__file__), "blender_manifest.toml")
        with open(manifest, encoding="utf-8") as file:
            self.assertIn(f'version = "{version}"\n', file.read().splitlines(keepends=True))

    def test_the_manifest_is_one_that_blender_4_takes(self):
        import tomllib
        import lapwing_blender
        with open(os.path.join(os.path.dirname(lapwing_blender.__file__), "blender_manifest.toml"), "rb") as file:
            manifest = tomllib.load(file)
        self.assertLessEqual(
            {"schema_version", "id", "version", "name", "tagline", "maintainer", "type",
             "blender_version_min", "license"}, set(manifest))
        for sentence in (manifest["tagline"], *manifest["permissions"].values()):
            self.assertLessEqual(len(sentence), 64)
            self.assertTrue(sentence[-1].isalnum(), sentence)


class Cancelling(SceneTest):
    def test_each_operation_of_each_engine_ends(self):
        from lapwing_blender import arrays, preferences
        from lapwing_blender.errors import Cancelled
        obj = scene.add_mesh("Large", *scene.grid(150, lambda x, y: 0.01 * np.sin(60 * x)))
        step = {
            "op": "deform", "roi": {"all": True},
            "handles": [{"region": {"vertices": [11400]}, "move": {"translate": [0, 0, 0.4]}}],
        }
        for engine in (scene.MODULE, scene.CLI):
            scene.use_engine(engine)
            with self.subTest(engine), self.assertRaises(Cancelled):
                preferences.chosen_engine(bpy.context).run(
                    arrays.object_arrays(obj), [step], {}, lambda _stage, _fraction: False
                )


scene.main()
