"""What the tests of the add-on share: the add-on installed, shapes, and the command line."""

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
    """Runs the tests of the file that calls it, as Blender's process."""
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
        """The operator reports one sentence that has these words, and no traceback."""
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
    """A square of side 2 in n x n cells, `height` a function of x and y; of quads, and with `mixed`
    of triangles and a hexagon as well."""
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
    """An object with bumps, a region in its middle and one handle in the middle of that."""
    vertices, faces = grid(n, lambda x, y: 0.05 * np.sin(9 * x) * np.cos(7 * y), mixed)
    obj = add_mesh("Wavy", vertices, faces, matrix)
    away = np.hypot(vertices[:, 0], vertices[:, 1])
    select(obj, away < 0.8)
    bpy.ops.lapwing.set_region(role="roi", source="SELECTION")
    select(obj, away < 0.2)
    bpy.ops.lapwing.add_handle()
    return obj


def select(obj, mask):
    """In object mode, vertices alone, as edit mode leaves them."""
    obj.data.vertices.foreach_set("select", np.asarray(mask, bool))


def empty_of(obj, handle=0):
    return obj.lapwing.handles[handle].empty


def move(obj, matrix, handle=0):
    """The Empty, by a matrix in the world."""
    empty = empty_of(obj, handle)
    empty.matrix_world = matrix @ empty.matrix_world
    bpy.context.view_layer.update()


def lift():
    return Matrix.Translation((0.1, -0.05, 0.4)) @ Matrix.Rotation(0.6, 4, "X")


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
    """What `lapwing run` makes of an exported recipe: its vertices."""
    done = subprocess.run([CLI, "run", str(path), "--device", "cpu", "--quiet"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    recipe = json.loads(Path(path).read_text())
    return ply_vertices(Path(path).parent / recipe["save"])


def ply_vertices(path):
    """Of a PLY file whose first three properties are x, y, z, in double precision or single."""
    data = Path(path).read_bytes()
    header, _, body = data.partition(b"end_header\n")
    lines = header.decode().splitlines()
    count = int(next(line for line in lines if line.startswith("element vertex")).split()[2])
    types = {"double": "<f8", "float": "<f4", "uint": "<u4", "int": "<i4"}
    start = next(k for k, line in enumerate(lines) if line.startswith("element vertex")) + 1
    fields = []
    for line in lines[start:]:
        if not line.startswith("property "):
            break
        _, kind, name = line.split()
        fields.append((name, types[kind]))
    rows = np.frombuffer(body, np.dtype(fields), count)
    return np.stack([rows[axis].astype(float) for axis in "xyz"], axis=1)
