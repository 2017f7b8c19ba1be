"""glTF files that the engine has edited, read by Blender."""

import os
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).parents[1] / "gltf"), os.environ["LAPWING_MODULE"]]

import bpy
import numpy as np
import lapwing
import test_gltf as debian
from mathutils.kdtree import KDTree
import samples
import scene
from scene import WORK, SceneTest, coordinates, in_world

# The glTF importer of Blender 3.4 uses `np.bool`, which numpy has removed.
np.bool = bool

#: Files that nobody reads, that have no triangles or numbers, or that Blender does not import even
#: unedited; and a mesh that Blender shifts by its bind matrices.
NOT_SHOWN = {
    *debian.REFUSED, *debian.EMPTY, *debian.NOT_FINITE, *debian.SHORT,
    "BoxTextured-glTF-techniqueWebGL/BoxTextured.gltf", "simple_skin/simple_skin.gltf",
    *(f"wrongTypes/bad{what}.gltf" for what in ("Extension", "Number", "Object", "String")),
}


def moved(points):
    return points + 0.3 * np.stack([np.sin(points[:, 1]), np.sin(points[:, 2]), points[:, 0] ** 2], 1)


class EditedFiles(SceneTest):
    def expect_moved(self, path):
        """Edits the file, and compares the mesh in Blender with that of the engine."""
        mesh = lapwing.read(path)
        target = WORK / ("edited" + path.suffix)
        lapwing.write(target, mesh.with_vertices(moved(mesh.vertices)))
        bpy.ops.import_scene.gltf(filepath=str(target))
        shown = np.concatenate([
            in_world(obj, coordinates(obj.data.vertices))
            for obj in bpy.context.scene.objects if obj.type == "MESH"
            and "Icosphere" not in obj.name  # what Blender draws bones with
        ])
        wanted = moved(mesh.vertices)[:, [0, 2, 1]] * [1, -1, 1]  # Blender's z points upwards
        tree = KDTree(len(shown))
        for k, point in enumerate(shown):
            tree.insert(point, k)
        tree.balance()
        size = np.ptp(wanted, 0).max()
        self.assertLess(max(tree.find(point)[2] for point in wanted), 1e-5 * size)


def add_test(name, path_of):
    setattr(EditedFiles, f"test_{name}", lambda self: self.expect_moved(path_of()))


for name, make in samples.ALL.items():
    add_test(name, lambda name=name, make=make: make().glb(WORK / f"{name}.glb"))
for path in debian.models():
    if isinstance(path, Path) and debian.name_of(path) not in NOT_SHOWN:
        add_test(debian.name_of(path), lambda path=path: path)


class MorphTarget(SceneTest):
    def test_it_is_a_shape_key(self):
        path = samples.plain().glb(WORK / "tube.glb")
        result = lapwing.run({
            "lapwing": 1, "mesh": "tube.glb", "save": "smiling.glb",
            "save_as": {"morph_target": "smile"},
            "steps": [{
                "op": "deform", "roi": {"all": True},
                "belt": {"box": {"min": [-9, -9, -9], "max": [9, 9, 1]}},
                "handles": [{"region": {"box": {"min": [-9, -9, 5.5], "max": [9, 9, 9]}},
                             "move": {"translate": [1, 0, 0]}}],
            }],
        }, folder=WORK, save=True)
        bpy.ops.import_scene.gltf(filepath=str(WORK / "smiling.glb"))
        obj = next(o for o in bpy.context.scene.objects if o.type == "MESH")
        keys = obj.data.shape_keys.key_blocks
        self.assertEqual([key.name for key in keys], ["Basis", "smile"])
        shown = in_world(obj, coordinates(keys["smile"].data))
        wanted = result.vertices[:, [0, 2, 1]] * [1, -1, 1]
        self.assertLess(np.abs(shown[:, None] - wanted[None]).max(2).min(1).max(), 1e-5)


if __name__ == "__main__":
    scene.main()
