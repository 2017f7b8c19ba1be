"""Wrap: a template onto a scan, with Empties as landmarks."""

import json

import bpy
import numpy as np
from mathutils import Matrix, Vector
import scene
from scene import SceneTest, coordinates, export, in_world, make_active, run_recipe

#: Where the scan is, seen from the template: elsewhere, rotated and larger.
PLACE = Matrix.Translation((4, 1, 0)) @ Matrix.Rotation(2.0, 4, (1, 2, 3)) @ Matrix.Scale(2.0, 4)
AXES = Matrix.Diagonal((1.0, 1.2, 1.5, 1.0))
CORNERS = {"right": (1, 0, 0), "back": (0, 1, 0), "top": (0, 0, 1), "left": (-1, 0, 0)}


def ball(name, subdivisions, matrix=None, shape=None):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, radius=1.0)
    obj = bpy.context.object
    obj.name = name
    if shape is not None:
        obj.data.transform(shape)
    if matrix is not None:
        obj.matrix_world = matrix
    bpy.context.view_layer.update()
    return obj


def mark(obj, name, place):
    """Adds an Empty at a place of the world, parented to the object."""
    empty = bpy.data.objects.new(name, None)
    bpy.context.scene.collection.objects.link(empty)
    empty.parent = obj
    empty.matrix_parent_inverse = obj.matrix_world.inverted()
    empty.location = place
    bpy.context.view_layer.update()
    return empty


def pair(matrix=None, names=tuple(CORNERS)):
    """Adds a template at `matrix` and a scan, with landmarks, and selects both."""
    template = ball("Template", 3, matrix)
    scan = ball("Scan", 4, PLACE, AXES)
    for name in names:
        corner = Vector(CORNERS[name])
        mark(template, name, template.matrix_world @ corner)
        mark(scan, name, PLACE @ AXES @ corner)
    make_active(template, scan)
    return template, scan


def error_of(template):
    """Returns the largest distance of the template's vertices from their true places."""
    local = coordinates(template.data.vertices)
    matrix = np.array((PLACE @ AXES).inverted())
    at = in_world(template, local) @ matrix[:3, :3].T + matrix[:3, 3]
    return np.abs(np.linalg.norm(at, axis=1) - 1.0).max()


class Wrap(SceneTest):
    def test_the_template_covers_the_scan_where_its_landmarks_are(self):
        tilted = Matrix.Rotation(0.5, 4, "X") @ Matrix.Diagonal((1.0, 1.0, 0.7, 1.0))
        for matrix in (None, tilted):
            with self.subTest(matrix):
                bpy.ops.wm.read_homefile(use_empty=True)
                template, scan = pair(matrix)
                before = np.array(template.matrix_world)
                seen = coordinates(scan.data.vertices)
                bpy.ops.lapwing.wrap()
                self.assertLess(error_of(template), 0.03)
                np.testing.assert_array_equal(np.array(template.matrix_world), before)
                np.testing.assert_array_equal(coordinates(scan.data.vertices), seen)

    def test_the_panel_shows_the_report(self):
        template, _ = pair()
        from lapwing_blender.operators_wrap import report_lines
        self.assertEqual(report_lines(template), [])
        bpy.ops.lapwing.wrap()
        lines = report_lines(template)
        self.assertIn("Covered by the scan: 100.0%", lines)
        self.assertIn("Flipped triangles: 0", lines)
        self.assertTrue(lines[0].startswith("Result to scan: 0."), lines)
        self.assertTrue(any(line.startswith("Landmarks: off by at most 0.") for line in lines))

    def test_without_landmarks_the_template_in_place_is_only_deformed(self):
        template = ball("Template", 3)
        make_active(template, ball("Scan", 4, None, AXES))
        bpy.ops.lapwing.wrap(aligned=True)
        top = in_world(template, coordinates(template.data.vertices))[:, 2].max()
        self.assertAlmostEqual(top, 1.5, delta=0.02)
        self.assertNotIn("landmarks", template["lapwing_edits"])

    def test_x_symmetry_keeps_the_template_symmetric(self):
        scan = ball("Scan", 4, None, AXES)
        for vertex in scan.data.vertices:
            if vertex.co.x > 0.0:
                vertex.co.x *= 0.8
        for symmetric in (False, True):
            with self.subTest(symmetric):
                bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=12)
                template = bpy.context.object
                template.data.use_mirror_x = symmetric
                rest = coordinates(template.data.vertices)
                images = [np.abs(rest - p * [-1, 1, 1]).sum(axis=1).argmin() for p in rest]
                make_active(template, scan)
                bpy.ops.lapwing.wrap(aligned=True)
                made = coordinates(template.data.vertices)
                gap = np.abs(made[images] * [-1, 1, 1] - made).max()
                self.assertEqual(gap < 1e-5, symmetric, gap)

    def test_detail_moves_vertices_exactly_onto_the_scan(self):
        template, _ = pair()
        bpy.ops.lapwing.wrap(detail=True, hard=True)
        self.assertLess(json.loads(template["lapwing_wrap"])["to_scan"]["percentile_95"], 1e-5)
        self.assertIn('"hard"', template["lapwing_edits"])

    def test_undo_brings_the_vertices_back(self):
        template, _ = pair()
        rest = coordinates(template.data.vertices)
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.lapwing.wrap()
        bpy.ops.ed.undo_push(message="wrap")
        bpy.ops.ed.undo()
        template = bpy.data.objects["Template"]
        np.testing.assert_array_equal(coordinates(template.data.vertices), rest)
        self.assertNotIn("lapwing_wrap", template)

    def test_the_template_can_be_wrapped_again(self):
        template, scan = pair()
        bpy.ops.lapwing.wrap()
        made = coordinates(template.data.vertices)
        top = bpy.data.objects["top"].matrix_world.translation
        self.assertLess((top - bpy.data.objects["top.001"].matrix_world.translation).length, 1e-5)
        make_active(template, scan)
        bpy.ops.lapwing.wrap()
        self.assertLess(np.abs(coordinates(template.data.vertices) - made).max(), 0.05)

    def test_both_engines_agree(self):
        made = []
        for engine in (scene.MODULE, scene.CLI):
            bpy.ops.wm.read_homefile(use_empty=True)
            scene.use_engine(engine)
            template, _ = pair()
            bpy.ops.lapwing.wrap()
            made.append((coordinates(template.data.vertices), template["lapwing_wrap"]))
        np.testing.assert_array_equal(made[0][0], made[1][0])
        self.assertEqual(made[0][1], made[1][1])

    def test_the_exported_recipe_gives_the_same_surface(self):
        template, _ = pair()
        bpy.ops.lapwing.wrap()
        expected = in_world(template, coordinates(template.data.vertices))
        self.assertLess(np.abs(run_recipe(export()) - expected).max(), 1e-5)

    def test_replayed_elsewhere_the_landmarks_go_along(self):
        template, _ = pair()
        original = template.data.copy()
        bpy.ops.lapwing.wrap()
        other = bpy.data.objects.new("Copy", original)
        bpy.context.scene.collection.objects.link(other)
        other.matrix_world = Matrix.Translation((0, -5, 2)) @ Matrix.Rotation(1.0, 4, "Y")
        make_active(other, template)
        bpy.context.view_layer.update()
        bpy.ops.lapwing.replay()
        made, expected = (in_world(each, coordinates(each.data.vertices)) for each in (other, template))
        self.assertLess(np.abs(made - expected).max(), 0.01)

    def test_landmarks_that_cannot_be_used_are_named(self):
        template, scan = pair()
        mark(template, "ear", (1, 0, 0))
        bpy.ops.lapwing.wrap()  # an Empty without a namesake is only a warning
        self.assertNotIn('"ear"', template["lapwing_edits"])
        mark(template, "ear.002", (1, 0, 0))
        make_active(template, scan)
        self.assert_refused("'ear' and 'ear.002' of 'Template' have the same name", bpy.ops.lapwing.wrap)

    def test_a_landmark_off_the_surface_is_refused(self):
        template, scan = pair()
        bpy.data.objects["top"].location = (0, 0, 1.5)
        bpy.context.view_layer.update()
        self.assert_refused('Point "top": the position (0, 0, 1.5)', bpy.ops.lapwing.wrap)

    def test_it_needs_a_scan(self):
        make_active(ball("Template", 2))
        self.assert_refused("The scan is not chosen", bpy.ops.lapwing.wrap)

    def test_shape_keys_are_transferred_to_a_mesh_of_other_faces(self):
        made = []
        for engine in (scene.MODULE, scene.CLI):
            bpy.ops.wm.read_homefile(use_empty=True)
            scene.use_engine(engine)
            source = ball("Source", 4)
            source.shape_key_add(name="Basis")
            for name, factor in (("long", 1.5), ("wide", 1.0)):
                key = source.shape_key_add(name=name)
                for point in key.data:
                    point.co.z *= factor
            source.data.shape_keys.key_blocks["wide"].relative_key = key
            target = ball("Target", 3)
            make_active(target, source)
            bpy.ops.lapwing.transfer_shape_keys(aligned=True)
            bpy.ops.lapwing.transfer_shape_keys(aligned=True)
            keys = target.data.shape_keys.key_blocks
            self.assertEqual([key.name for key in keys], ["Basis", "long", "wide"])
            rest, long, wide = (coordinates(key.data) for key in keys)
            self.assertLess(np.abs(long - rest * [1.0, 1.0, 1.5]).max(), 0.05)
            self.assertLess(np.abs(wide - rest).max(), 1e-4)
            made.append(long)
        self.assertLess(np.abs(made[0] - made[1]).max(), 1e-6)

    def test_a_source_without_shape_keys_is_refused(self):
        target = ball("Target", 2)
        make_active(target, ball("Source", 2))
        self.assert_refused("'Source' has no shape keys besides its basis",
                            bpy.ops.lapwing.transfer_shape_keys)


scene.main()
