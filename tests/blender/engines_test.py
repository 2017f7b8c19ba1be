"""The engine as a Python module and as a program: both give the same results."""

import os
import subprocess
import tempfile
import tomllib

import bpy
import numpy as np
import scene
from scene import SceneTest, coordinates, deform, drag, wavy


def edited(engine, operation):
    """Returns the vertices and the face sizes after an operation by this engine."""
    bpy.ops.wm.read_homefile(use_empty=True)
    scene.use_engine(engine)
    obj = operation()
    sizes = [len(polygon.vertices) for polygon in obj.data.polygons]
    return coordinates(obj.data.vertices), sizes


def deformed():
    obj = wavy()
    deform(obj)
    return obj


def dragged():
    obj = wavy()
    drag(obj)
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


def manifest_of(addon):
    path = os.path.join(os.path.dirname(addon.__file__), "blender_manifest.toml")
    with open(path, "rb") as file:
        return tomllib.load(file)


class BothEngines(SceneTest):
    def test_they_agree(self):
        for operation in (deformed, dragged, coated, peeled):
            with self.subTest(operation.__name__):
                by_module, faces = edited(scene.MODULE, operation)
                by_program, program_faces = edited(scene.CLI, operation)
                self.assertEqual(faces, program_faces)
                np.testing.assert_allclose(by_program, by_module, atol=1e-6)

    def test_the_program_leaves_no_files(self):
        scene.use_engine(scene.CLI)
        obj = wavy()
        folder = tempfile.gettempdir()
        before = {name for name in os.listdir(folder) if name.startswith("lapwing-")}
        deform(obj)
        left = {name for name in os.listdir(folder) if name.startswith("lapwing-")} - before
        self.assertEqual(left, set())

    def test_the_add_on_has_the_engine_s_version(self):
        import lapwing_blender
        said = subprocess.run([scene.CLI, "--version"], capture_output=True, text=True, check=True)
        version = ".".join(map(str, lapwing_blender.bl_info["version"]))
        self.assertEqual(said.stdout.split()[-1], version)
        self.assertEqual(manifest_of(lapwing_blender)["version"], version)

    def test_the_manifest_is_one_that_blender_4_takes(self):
        import lapwing_blender
        manifest = manifest_of(lapwing_blender)
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
