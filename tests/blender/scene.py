"""Helpers of the add-on's tests: they install the add-on, make shapes and run the command line."""

import json
import os
import subprocess
import sys
import unittest
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix

CLI = os.environ["LAPWING_CLI"]
MODULE = os.environ["LAPWING_MODULE"]
WORK = Path(os.environ["LAPWING_WORK"])
ADDON = "lapwing_blender"


def install():
    bpy.ops.preferences.addon_install(filepath=os.environ["LAPWING_ADDON"])
    bpy.ops.preferences.addon_enable(module=ADDON)
    use_engine(MODULE)


def use_engine(path):
    bpy.context.preferences.addons[ADDON].preferences.engine_path = str(path)


def main():
    """Runs the tests of the calling file in Blender's process."""
    install()
    names = sys.argv[sys.argv.index("--") + 1:]
    program = unittest.main(module="__main__", argv=["tests", "-v", *names], exit=False)
    if not program.result.wasSuccessful():
        raise SystemExit(1)


class SceneTest(unittest.TestCase):
    def setUp(self):
        bpy.ops.wm.read_homefile(use_empty=True)
        use_engine(MODULE)

    def assert_refused(self, words, operator, **properties):
        """Expects that the operator reports one sentence with these words, and no traceback."""
        with self.assertRaises(RuntimeError) as caught:
            operator(**properties)
        said = str(caught.exception).strip()
        self.assertIn(words, said)
        self.assertNotIn("Traceback", said)
        self.assertEqual(len(said.splitlines()), 1, said)


def add_mesh(name, vertices, faces, matrix=None):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], [], [list(map(int, f)) for f in faces])
    mesh.update()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    if matrix is not None:
        obj.matrix_world = matrix
    make_active(obj)
    bpy.context.view_layer.update()
    return obj


def make_active(obj, *others):
    bpy.ops.object.select_all(action="DESELECT")
    for each in (obj, *others):
        each.select_set(True)
    bpy.context.view_layer.objects.active = obj


def grid(n, height, mixed=False):
    """Returns a square of side 2 with n x n quads, lifted by `height`, a function of x and y. With
    `mixed` it also has triangles and a hexagon."""
    x, y = (a.ravel() for a in np.meshgrid(*2 * [np.linspace(-1.0, 1.0, n + 1)], indexing="ij"))
    faces = []
    for i in range(n):
        for j in range(n):
            a = i * (n + 1) + j
            quad = [a, a + n + 1, a + n + 2, a + 1]
            if mixed and (i, j) == (1, 1):
                faces.append([a, a + n + 1, a + n + 2, a + n + 3, a + 2, a + 1])  # with its neighbour
            elif mixed and (i, j) == (1, 2):
                continue
            elif mixed and (i + j) % 3 == 0:
                faces += [quad[:3], [quad[0], quad[2], quad[3]]]
            else:
                faces.append(quad)
    return np.stack([x, y, height(x, y)], axis=1), faces


def wavy(matrix=None, n=24, mixed=True):
    """Adds an object with bumps, a region in its middle and one handle in the middle of the region."""
    vertices, faces = grid(n, lambda x, y: 0.05 * np.sin(9 * x) * np.cos(7 * y), mixed)
    obj = add_mesh("Wavy", vertices, faces, matrix)
    away = np.hypot(vertices[:, 0], vertices[:, 1])
    select(obj, away < 0.8)
    bpy.ops.lapwing.set_region(role="roi", source="SELECTION")
    select(obj, away < 0.2)
    bpy.ops.lapwing.add_handle()
    return obj


def select(obj, mask):
    """Selects vertices in object mode."""
    obj.data.vertices.foreach_set("select", np.asarray(mask, bool))


def empty_of(obj, handle=0):
    return obj.lapwing.handles[handle].empty


def move(obj, matrix, handle=0):
    """Moves the Empty of a handle by a matrix in the world."""
    empty = empty_of(obj, handle)
    empty.matrix_world = matrix @ empty.matrix_world
    bpy.context.view_layer.update()


def lift():
    return Matrix.Translation((0.1, -0.05, 0.4)) @ Matrix.Rotation(0.6, 4, "X")


def drag(obj, matrix=None):
    """Starts an edit, moves its handle and shows the linear response."""
    bpy.ops.lapwing.start()
    move(obj, matrix or lift())
    bpy.ops.lapwing.respond()


def deform(obj, matrix=None, **properties):
    """Makes an edit from its start to its result."""
    make_active(obj)
    bpy.ops.lapwing.start()
    move(obj, matrix or lift())
    bpy.ops.lapwing.apply(**properties)


def export(name="recipe.json", **properties):
    path = WORK / name
    bpy.ops.lapwing.export_recipe(filepath=str(path), **properties)
    return path


def coordinates(points):
    flat = np.empty(3 * len(points), np.float32)
    points.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def in_world(obj, local):
    matrix = np.array(obj.matrix_world)
    return local.astype(float) @ matrix[:3, :3].T + matrix[:3, 3]


def diagonal(points):
    return float(np.linalg.norm(np.ptp(points, axis=0)))


def run_recipe(path):
    """Runs an exported recipe with `lapwing run`. Returns the vertices of the result."""
    done = subprocess.run([CLI, "run", str(path), "--device", "cpu", "--quiet"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    from lapwing_blender.ply import read_ply
    recipe = json.loads(Path(path).read_text())
    return read_ply(Path(path).parent / recipe["save"], vertices_only=True).vertices
