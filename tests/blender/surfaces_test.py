"""Coat, mix, transplant and peel."""

import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import SceneTest, coordinates, in_world, make_active

FINE = 0.02
BUMPS = 18.0


def bumpy(x, y):
    return FINE * np.sin(BUMPS * x) * np.sin(BUMPS * y)


def bumps(matrix=None, n=40):
    return scene.add_mesh("Bumps", *scene.grid(n, bumpy), matrix)


def plain(matrix=None, n=40, mixed=False):
    return scene.add_mesh("Plain", *scene.grid(n, lambda x, y: 0 * x, mixed), matrix)


def tube(matrix, around=24, along=16, radius=0.25, length=1.0):
    """Adds a tube along z, wider at its lower end, of quads that face outward."""
    angle = 2 * np.pi * np.arange(around) / around
    vertices = [
        (*((1 - 0.3 * k / along) * radius * np.array([np.cos(a), np.sin(a)])), length * k / along)
        for k in range(along + 1) for a in angle
    ]
    faces = [
        [low + j, low + (j + 1) % around, low + around + (j + 1) % around, low + around + j]
        for low in range(0, along * around, around) for j in range(around)
    ]
    return scene.add_mesh("Tube", vertices, faces, matrix)


def roughness(obj, inside):
    """Returns the standard deviation of the heights of the vertices inside."""
    return float(np.std(in_world(obj, coordinates(obj.data.vertices))[inside, 2]))


def inner(obj, radius=0.5):
    place = in_world(obj, coordinates(obj.data.vertices))
    return np.hypot(place[:, 0], place[:, 1]) < radius


class Coat(SceneTest):
    where = dict(region="CURSOR", radius=0.9, detail_size=0.6, source="Bumps")

    def test_the_detail_comes_over(self):
        source, target = bumps(Matrix.Translation((8, 0, 0))), plain()
        bpy.ops.lapwing.coat(**self.where)
        self.assertGreater(roughness(target, inner(target)), 0.5 * roughness(source, slice(None)))

    def test_the_other_selected_object_is_the_source(self):
        source, target = bumps(Matrix.Translation((8, 0, 0))), plain()
        make_active(target, source)
        bpy.ops.lapwing.coat(**{**self.where, "source": ""})
        self.assertGreater(roughness(target, inner(target)), 0.003)

    def test_lengths_are_those_of_the_world_for_objects_of_other_scales(self):
        """The same surfaces, whether they are large by their vertices or by their objects."""
        bumps(Matrix.Translation((8, 0, 0)))
        target = plain()
        bpy.ops.lapwing.coat(**self.where)
        expected = roughness(target, inner(target))
        bpy.ops.wm.read_homefile(use_empty=True)
        for make, scale in ((bumps, 10.0), (plain, 0.01)):
            obj = make(Matrix.Translation((8, 0, 0)) if make is bumps else None)
            obj.data.transform(Matrix.Scale(1.0 / scale, 4))
            obj.matrix_world = obj.matrix_world @ Matrix.Scale(scale, 4)
        bpy.context.view_layer.update()
        bpy.ops.lapwing.coat(**self.where)
        obj = bpy.data.objects["Plain"]
        # Rounding lets remeshing choose other triangles on the same surface.
        self.assertAlmostEqual(roughness(obj, inner(obj)), expected, delta=0.05 * expected)

    def test_a_mirrored_object_is_coated_on_the_side_that_is_seen(self):
        """Bumps that stand out on one side, on objects that mirror the mesh."""
        for scale in (1.0, -1.0):
            with self.subTest(scale):
                bpy.ops.wm.read_homefile(use_empty=True)
                scene.add_mesh("Bumps", *scene.grid(40, lambda x, y: np.maximum(bumpy(x, y), 0.0)),
                               Matrix.Translation((8, 0, 0)))
                # Blender shows the front of both on top.
                target = plain(Matrix.Diagonal((scale, 1, 1, 1)))
                bpy.ops.lapwing.coat(**self.where)
                z = in_world(target, coordinates(target.data.vertices))[inner(target), 2]
                self.assertGreater(z.max(), 1.5 * -z.min())

    def test_in_edit_mode_the_selected_faces_are_coated(self):
        bumps(Matrix.Translation((8, 0, 0)))
        target = plain()
        scene.select(target, inner(target, 0.7))
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.lapwing.coat(**{**self.where, "region": "SELECTION"})
        self.assertEqual(target.mode, "EDIT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.assertGreater(roughness(target, inner(target, 0.4)), 0.003)

    def test_materials_weights_and_uv_maps_stay_where_the_mesh_gets_finer(self):
        bumps(Matrix.Translation((8, 0, 0)))
        target = plain(n=12)
        before = coordinates(target.data.vertices)
        for name in ("Left", "Right"):
            target.data.materials.append(bpy.data.materials.new(name))
        for polygon in target.data.polygons:
            polygon.material_index = int(polygon.center.x > 0.0)
        left = target.vertex_groups.new(name="Weights")
        left.add([v for v in range(len(before)) if before[v, 0] < 0.0], 0.5, "REPLACE")
        layer = target.data.uv_layers.new(name="Map")
        for loop in target.data.loops:
            layer.data[loop.index].uv = before[loop.vertex_index, :2]

        bpy.ops.lapwing.coat(**self.where)
        mesh = target.data
        self.assertGreater(len(mesh.vertices), 2 * len(before))
        for polygon in mesh.polygons:
            if abs(polygon.center.x) > 0.3:
                self.assertEqual(polygon.material_index, int(polygon.center.x > 0.0))
        self.assertEqual(target.vertex_groups.keys(), ["Weights"])
        weighted = {v.index for v in mesh.vertices if any(g.weight > 0.4 for g in v.groups)}
        for v in mesh.vertices:
            if abs(v.co.x) > 0.3:
                self.assertEqual(v.index in weighted, v.co.x < 0.0)
        for loop in mesh.loops:
            uv, place = mesh.uv_layers["Map"].data[loop.index].uv, mesh.vertices[loop.vertex_index].co
            self.assertLess((uv - place.xy).length, 0.1)

    def test_undo_brings_the_old_faces_back(self):
        bumps(Matrix.Translation((8, 0, 0)))
        target = plain(n=12)
        faces = len(target.data.polygons)
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.lapwing.coat(**self.where)
        bpy.ops.ed.undo_push(message="coat")
        self.assertGreater(len(target.data.polygons), faces)
        bpy.ops.ed.undo()
        self.assertEqual(len(bpy.data.objects["Plain"].data.polygons), faces)


class Mix(SceneTest):
    def test_the_source_s_detail_away_from_the_cursor_and_the_own_near_it(self):
        bumps(Matrix.Translation((8, 0, 0)))
        target = plain()
        bpy.ops.lapwing.mix(region="CURSOR", radius=0.95, detail_size=0.6, own_detail_size=0.2,
                            own_radius=0.3, width=0.1, source="Bumps")
        near = inner(target, 0.25)
        ring = inner(target, 0.7) & ~inner(target, 0.5)
        self.assertGreater(roughness(target, ring), 5 * roughness(target, near))


class Transplant(SceneTest):
    def test_a_part_stands_where_the_cursor_is(self):
        tube(Matrix.Translation((5, 0, 0)))
        target = plain()
        bpy.context.scene.cursor.location = (0.2, 0.1, 0)
        bpy.ops.lapwing.transplant(region="CURSOR", radius=0.3, part="Tube")
        place = in_world(target, coordinates(target.data.vertices))
        self.assertGreater(place[:, 2].max(), 0.7)
        tip = place[place[:, 2] > 0.7]
        self.assertLess(np.abs(tip[:, :2].mean(axis=0) - [0.2, 0.1]).max(), 0.1)

    def test_a_part_stays_where_it_is_in_the_scene(self):
        tube(Matrix.Translation((0, 0, 0.1)) @ Matrix.Diagonal((1, 1, 2, 1)))
        target = plain(Matrix.Scale(2.0, 4))
        scene.select(target, inner(target, 0.35))
        before = np.array(bpy.data.objects["Tube"].matrix_world)
        bpy.ops.lapwing.transplant(region="SELECTION", place="WORLD", part="Tube")
        self.assertAlmostEqual(in_world(target, coordinates(target.data.vertices))[:, 2].max(), 2.1, places=4)
        np.testing.assert_array_equal(np.array(bpy.data.objects["Tube"].matrix_world), before)

    def test_the_surface_is_joined(self):
        tube(Matrix.Translation((5, 0, 0)))
        target = plain()
        bpy.ops.lapwing.transplant(region="CURSOR", radius=0.3, part="Tube")
        uses = np.zeros(len(target.data.edges), int)
        for polygon in target.data.polygons:
            for key in (target.data.loops[i].edge_index for i in polygon.loop_indices):
                uses[key] += 1
        self.assertEqual(uses.max(), 2)
        # The boundary edges are those of the sheet and of the tube's open end.
        self.assertEqual((uses == 1).sum(), 4 * 40 + 24)


class Peel(SceneTest):
    def test_bumps_go_and_the_shape_stays(self):
        obj = scene.add_mesh("Bent", *scene.grid(40, lambda x, y: 0.2 * x * x + bumpy(x, y)))
        before = coordinates(obj.data.vertices)
        bpy.ops.lapwing.peel(region="ALL", detail_size=0.6)
        after = coordinates(obj.data.vertices)
        inside = inner(obj, 0.7)
        shape = 0.2 * before[:, 0] ** 2
        self.assertLess(np.std((after[:, 2] - shape)[inside]), 0.3 * np.std((before[:, 2] - shape)[inside]))

    def test_outside_the_group_nothing_moves(self):
        obj = bumps()
        rest = coordinates(obj.data.vertices)
        inside = inner(obj, 0.5)
        group = obj.vertex_groups.new(name="Here")
        group.add(np.flatnonzero(inside).tolist(), 1.0, "REPLACE")
        bpy.ops.lapwing.peel(region="GROUP", group="Here", detail_size=0.6)
        moved = (coordinates(obj.data.vertices) != rest).any(axis=1)
        self.assertTrue(moved.any())
        self.assertFalse(moved[~inside].any())


scene.main()
