#!/usr/bin/python3
"""Sessions of a user in the real window: each opens a mesh, works with the mouse and the keyboard,
saves, and then compares the files with each other and with `lapwing run`.

    LAPWING_VIEWER=... LAPWING_CLI=... LAPWING_MODELS=... PYTHONPATH=build/release/python \\
      tests/viewer_sessions/sessions_test.py [Sessions.SESSION...]
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

import lapwing
import numpy as np

import window

CLI = os.environ.get("LAPWING_CLI", "lapwing")
MODELS = pathlib.Path(os.environ["LAPWING_MODELS"]) / "cgal/meshes"
SKIPPED = 77
#: A saved mesh and a run of its recipe may differ by this share of the diagonal.
SAME = 1e-3

# Places in a window of this size, in pixels. The camera frames a newly opened mesh.
TRANSPLANT_TAB = (210, 42)
MESH_TAB = (280, 42)
MORE_PARTS = (40, 101)
NAME_OF_PART = (150, 221)
APPLY = (34, 480)


def diagonal(mesh):
    return np.linalg.norm(np.ptp(mesh.vertices, axis=0))


def distance(a, b):
    """The largest distance of corresponding vertices, relative to the diagonal."""
    return np.linalg.norm(a.vertices - b.vertices, axis=1).max() / diagonal(a)


def distance_from_rigid(before, after):
    """The largest distance of points from the best rigid motion of `before`."""
    p, q = before - before.mean(0), after - after.mean(0)
    u, _, vt = np.linalg.svd(p.T @ q)
    flip = np.diag([1, 1, np.sign(np.linalg.det(u @ vt))])
    return np.linalg.norm(p @ (u @ flip @ vt) - q, axis=1).max()


class Sessions(unittest.TestCase):
    def setUp(self):
        self.window = window.Window(self._testMethodName.removeprefix("test_"))
        self.addCleanup(self.window.close)
        self.folder = self.window.folder

    def open(self, name):
        """Opens a copy of a model, which the session may damage."""
        mesh = self.model(name)
        self.window.start(mesh)
        self.window.keep_picture("opened")
        return mesh

    def model(self, name):
        return pathlib.Path(shutil.copy(MODELS / name, self.folder))

    def save_and_run(self, name):
        """Saves the mesh and the recipe, and checks that the recipe makes the mesh."""
        mesh, recipe, made = (self.folder / f"{name}{end}" for end in (".obj", ".json", "-run.obj"))
        self.window.save("ctrl+e", recipe)
        self.window.save("ctrl+s", mesh)
        self.window.keep_picture("saved")
        subprocess.run([CLI, "run", recipe, "--save", made], check=True, capture_output=True)
        saved, run = lapwing.read(mesh), lapwing.read(made)
        self.assertTrue(np.array_equal(saved.faces, run.faces))
        self.assertLess(distance(saved, run), SAME)
        return saved, json.loads(recipe.read_text())["steps"]

    def test_three_limbs_are_posed_by_grab_alone(self):
        begin = time.monotonic()
        scan = lapwing.read(self.open("armadillo.off"))
        self.window.drag((1000, 160), (1020, 110), (1035, 70))  # the right arm
        self.window.wait_for_steps(1)
        self.window.drag((640, 560), (600, 520), (560, 480))  # the tail
        self.window.wait_for_steps(2)
        self.window.drag((885, 115), (920, 90), (950, 100))  # an ear
        self.window.wait_for_steps(3)
        self.window.keep_picture("posed")
        self.assertLess(time.monotonic() - begin, 60)
        posed, steps = self.save_and_run("pose")
        self.assertEqual([step["op"] for step in steps], ["deform"] * 3)
        self.assertGreater(distance(scan, posed), 0.05)

    def test_painted_armour_moves_rigidly(self):
        animal = lapwing.read(self.open("elephant.off"))
        self.window.keys("shift+p")
        self.window.drag((815, 165), (835, 150), (850, 145))
        self.window.settle()
        self.window.keep_picture("painted")
        self.window.keys("shift+g")
        self.window.drag((870, 125), (930, 150), (960, 220), (960, 260), held="ctrl")
        self.window.wait_for_steps(1)
        moved, (step,) = self.save_and_run("armour")
        (stiff,) = step["stiffness"]
        self.assertEqual(stiff["factor"], "rigid")
        painted = stiff["region"]["vertices"]
        motion = np.linalg.norm(moved.vertices - animal.vertices, axis=1)
        self.assertGreater(len(painted), 8)
        self.assertGreater(motion[painted].max(), 0.05 * diagonal(animal))
        bent = distance_from_rigid(animal.vertices[painted], moved.vertices[painted])
        self.assertLess(bent, SAME * diagonal(animal))
        limb = motion > 0.01 * diagonal(animal)
        flexible = distance_from_rigid(animal.vertices[limb], moved.vertices[limb])
        self.assertGreater(flexible, 10 * SAME * diagonal(animal))

    def test_a_coat_of_a_scan_is_put_on_an_ear(self):
        self.open("elephant.off")
        self.window.keys("d", "i")
        self.window.drag((810, 510), (850, 560))
        self.window.settle()
        self.window.keys("ctrl+k")
        self.window.settle()
        self.window.keys("ctrl+shift+k")
        self.window.settle()
        self.window.type(self.model("armadillo.off"))
        self.window.keys("Return")
        self.window.settle()
        self.window.drag((560, 260), (600, 320))
        self.window.settle()
        self.window.keep_picture("preview")
        self.window.keys("ctrl+Return")
        self.window.wait_for_steps(1)
        coated, (step,) = self.save_and_run("coated")
        self.assertEqual((step["op"], step["source"]), ("coat", "armadillo.off"))
        self.assertGreater(coated.vertex_count, 3000)  # the patch was remeshed

    def test_a_trunk_is_cut_out_and_transplanted(self):
        self.open("elephant.off")
        self.window.keys("d", "i")
        self.window.drag((875, 129), (815, 200))
        self.window.settle()
        self.window.click(*TRANSPLANT_TAB)
        self.window.settle()
        self.window.click(*MORE_PARTS)
        self.window.settle()
        self.window.click(*NAME_OF_PART)
        self.window.type("trunk")
        self.window.keys("Return")
        part = self.folder / "home/data/lapwing/parts/trunk.obj"
        window.wait_for("the part is written", part.exists)
        self.window.settle()
        self.window.keep_picture("cut")
        cow = self.model("cow.off")
        self.window.keys("ctrl+o")
        self.window.settle()
        self.window.type(cow)
        self.window.keys("Return")
        window.wait_for("the cow opens", lambda: "cow.off" in self.window.title())
        self.window.settle()
        self.window.keys("n")
        self.window.settle()
        self.window.click(850, 300)
        self.window.settle()
        self.window.keep_picture("placed")
        self.window.keys("Return")
        self.window.wait_for_steps(1)
        joined, (step,) = self.save_and_run("chimera")
        self.assertEqual(step["op"], "transplant")
        self.assertGreater(joined.vertex_count, lapwing.read(cow).vertex_count)
        self.assertEqual(len(lapwing.check(joined).holes), 0)

    def test_the_holes_of_a_mesh_are_filled(self):
        mesh = self.open("elephant-with-holes.off")
        before = len(lapwing.check(lapwing.read(mesh)).holes)
        self.window.click(*MESH_TAB)
        self.window.settle()
        self.window.click(40, 287)  # "Holes"
        self.window.settle()
        self.window.keep_picture("holes")
        self.window.click(35, 398)  # "Fill all"
        self.window.settle()
        self.window.keep_picture("preview")
        self.window.click(*APPLY)
        self.window.wait_for_steps(1)
        filled, (step,) = self.save_and_run("closed")
        self.assertEqual(step["op"], "fill_holes")
        self.assertGreater(before, 100)
        self.assertEqual(len(lapwing.check(filled).holes), 0)

    def test_the_first_save_asks_and_keeps_the_opened_file(self):
        mesh = self.open("cow.off")
        original = mesh.read_bytes()
        self.window.drag((1125, 310), (1150, 260), (1160, 200))
        self.window.wait_for_steps(1)
        files = set(self.folder.glob("*.off"))
        self.window.keys("ctrl+s")
        self.window.settle()
        self.window.keep_picture("asked")
        self.assertEqual(set(self.folder.glob("*.off")), files)
        self.window.type(mesh)  # replaces the suggested name
        self.window.keys("Return")
        self.window.settle()
        self.window.keep_picture("replace")
        self.window.keys("Escape")
        self.window.settle()
        self.assertEqual(mesh.read_bytes(), original)
        self.window.keys("Escape")
        self.window.settle()
        self.window.keys("ctrl+s")
        self.window.settle()
        self.window.keys("Return")
        edited = self.folder / "cow-edited.off"
        window.wait_for("the suggested file is written", edited.exists)
        window.wait_for("the title follows", lambda: self.window.title() == "cow-edited.off - Lapwing")
        self.assertEqual(mesh.read_bytes(), original)
        self.assertGreater(distance(lapwing.read(mesh), lapwing.read(edited)), 0.02)

    def test_edits_and_the_redo_list_survive_a_kill(self):
        self.open("cow.off")
        self.window.drag((1125, 310), (1150, 260), (1160, 200))
        self.window.wait_for_steps(1)
        self.window.drag((828, 620), (870, 600), (920, 590))
        self.window.wait_for_steps(2)
        self.window.save("ctrl+e", self.folder / "before.json")
        self.window.keys("ctrl+z")
        self.window.wait_for_steps(1)
        self.window.kill()
        self.restore()
        self.window.keep_picture("restored")
        self.window.wait_for_steps(1)
        self.window.keys("ctrl+shift+z")
        self.window.wait_for_steps(2)
        self.window.drag((700, 250), (700, 200), release=False)
        self.window.kill()
        self.window.xdotool("mouseup", "1")
        self.restore()
        self.window.wait_for_steps(2)
        self.window.keep_picture("restored-again")
        # The Grab tool is still active.
        self.window.drag((528, 560), (500, 540), (470, 530))
        self.window.wait_for_steps(3)
        _, steps = self.save_and_run("after")
        self.assertEqual(steps[:2], json.loads((self.folder / "before.json").read_text())["steps"])

    def restore(self):
        """Starts the viewer, which offers the interrupted edit, and takes the offer."""
        (journal,) = self.window.journals()
        self.window.start()
        self.window.keep_picture("offered")
        self.window.keys("Return")
        window.wait_for("the old journal is replaced", lambda: not journal.exists())
        self.window.settle()


def missing():
    return [program for program in ("Xvfb", "xdotool") if shutil.which(program) is None]


if __name__ == "__main__":
    if missing():
        print("Missing:", *missing(), "- tools/setup/install-packages installs them", file=sys.stderr)
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    unittest.main(verbosity=2)
