"""Keyframed Empties, baked over a range of frames."""

import struct

import bpy
import numpy as np
from mathutils import Matrix
import scene
from scene import SceneTest, coordinates, wavy

FRAMES = 24


def waving():
    """The handle rises and turns from frame 1 to 24."""
    obj = wavy(Matrix.Translation((1, 0, 0)) @ Matrix.Diagonal((1, -1, 2, 1)))
    empty = scene.empty_of(obj)
    for frame, height, turn in ((1, 0.0, 0.0), (FRAMES, 0.5, 0.8)):
        empty.location.z = height
        empty.rotation_euler.x = turn
        empty.keyframe_insert("location", frame=frame)
        empty.keyframe_insert("rotation_euler", frame=frame)
    bpy.context.scene.frame_set(1)
    bpy.ops.lapwing.set_rest()
    return obj


def live_at(obj, frame):
    """The settled surface of a live edit at a frame."""
    bpy.context.scene.frame_set(frame)
    bpy.ops.lapwing.settle()
    return coordinates(obj.data.vertices)


def shown_at(obj, frame):
    bpy.context.scene.frame_set(frame)
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    return coordinates(shown.vertices)


class Bake(SceneTest):
    def expected(self, obj, frames):
        bpy.context.scene.frame_set(1)
        bpy.ops.lapwing.start()
        surfaces = {frame: live_at(obj, frame) for frame in frames}
        bpy.ops.lapwing.cancel()
        bpy.context.scene.frame_set(1)
        return surfaces

    def assert_shows(self, obj, expected):
        for frame, surface in expected.items():
            with self.subTest(frame=frame):
                np.testing.assert_allclose(shown_at(obj, frame), surface, atol=1e-6)

    def test_shape_keys_show_each_frame(self):
        obj = waving()
        expected = self.expected(obj, (1, 7, 12, 24))
        self.assertGreater(np.abs(expected[24] - expected[1]).max(), 0.1)
        bpy.ops.lapwing.bake(first=1, last=FRAMES)
        self.assertEqual(len(obj.data.shape_keys.key_blocks), 1 + FRAMES)
        self.assert_shows(obj, expected)

    def test_caches_show_each_frame(self):
        for kind in ("PC2", "MDD"):
            with self.subTest(kind):
                bpy.ops.wm.read_homefile(use_empty=True)
                obj = waving()
                obj.modifiers.new("Subdivision", "SUBSURF").show_viewport = False
                expected = self.expected(obj, (1, 7, 12, 24))
                path = scene.WORK / f"cache.{kind.lower()}"
                bpy.ops.lapwing.bake(first=1, last=FRAMES, kind=kind, cache_file=str(path))
                self.assertEqual([m.type for m in obj.modifiers], ["MESH_CACHE", "SUBSURF"])
                self.assert_shows(obj, expected)

    def test_a_cache_has_the_frames_asked_for(self):
        obj = waving()
        path = scene.WORK / "few"
        bpy.ops.lapwing.bake(first=3, last=9, kind="PC2", cache_file=str(path))
        data = path.with_suffix(".pc2").read_bytes()
        name, version, points, start, rate, count = struct.unpack("<12siiffi", data[:32])
        self.assertEqual((name, version, start, rate, count), (b"POINTCACHE2\0", 1, 3.0, 1.0, 7))
        self.assertEqual(points, len(obj.data.vertices))
        self.assertEqual(len(data), 32 + 7 * points * 12)

    def test_the_frame_and_the_mesh_are_as_before(self):
        obj = waving()
        rest = coordinates(obj.data.vertices)
        bpy.context.scene.frame_set(5)
        bpy.ops.lapwing.bake(first=1, last=3, kind="MDD", cache_file=str(scene.WORK / "rest"))
        self.assertEqual(bpy.context.scene.frame_current, 5)
        np.testing.assert_array_equal(coordinates(obj.data.vertices), rest)


scene.main()
