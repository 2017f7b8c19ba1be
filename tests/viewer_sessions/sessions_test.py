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
WRAP_TAB = (165, 42)
TRANSPLANT_TAB = (228, 42)
MESH_TAB = (291, 42)
OPEN_SCAN = (57, 90)
LOAD_LANDMARKS = (122, 143)  # while there are none
WRAP = (33, 480)
COAT_DETAIL = (217, 480)  # once it is wrapped
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


def normals_of(mesh):
    corners = mesh.vertices[mesh.faces]
    of_faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(normals, mesh.faces[:, k], of_faces)
    return normals / np.linalg.norm(normals, axis=1)[:, None]


def heights_over(mesh, points):
    """The distances of points near a dense mesh from it, along the normals of its vertices."""
    normals, heights = normals_of(mesh), []
    for part in np.array_split(points, len(points) // 50 + 1):
        off = part[:, None] - mesh.vertices
        nearest = (off**2).sum(2).argmin(1)
        heights.append((off[np.arange(len(part)), nearest] * normals[nearest]).sum(1))
    return np.abs(np.concatenate(heights))


def scan_of(mesh):
    """A scan of the mesh, bent, stretched, turned and enlarged, with finer triangles and ripples.
    Also returns the places of the mesh's vertices on it."""
    size, by_height = diagonal(mesh), np.argsort(mesh.vertices[:, 1])
    held = len(by_height) // 20
    lean = {"translate": [0.1 * size, 0, 0.03 * size], "rotate": {"axis": [0, 0, 1], "degrees": -20}}
    bent = lapwing.deform(
        mesh.vertices, mesh.faces, roi="all", belt={"vertices": by_height[:held].tolist()},
        handles=[({"vertices": by_height[-held:].tolist()}, lean)],
    ).vertices  # fmt: skip
    fine = lapwing.remesh(bent, mesh.faces, scale=0.3).mesh
    waves = np.sin(fine.vertices @ np.array([[200, 0], [120, 150], [0, 170]]) / size).prod(1)
    scan = fine.vertices + 0.0025 * size * waves[:, None] * normals_of(fine)
    turn = np.radians(25)
    away = np.array([[np.cos(turn), 0, np.sin(turn)], [0, 1, 0], [-np.sin(turn), 0, np.cos(turn)]])

    def placed(points):
        return 1.7 * (points * [1.1, 0.95, 1.05]) @ away.T + size * np.array([2, 1, -1])

    return lapwing.Mesh(placed(scan), fine.faces), placed(bent)


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

    def open_with_scan(self):
        """Opens a template, and a scan of it in the second view."""
        animal = lapwing.read(self.open("elephant.off"))
        scan, places = scan_of(animal)
        lapwing.write(self.folder / "scan.off", scan)
        self.window.click(*WRAP_TAB)
        self.window.settle()
        self.answer(OPEN_SCAN, self.folder / "scan.off")
        self.window.settle()
        return animal, scan, places

    def answer(self, button, path):
        """Clicks a button that asks for a path."""
        self.window.click(*button)
        self.window.settle()
        self.window.type(path)
        self.window.keys("Return")
        self.window.settle()

    def wrap(self, picture):
        """Clicks "Wrap" and waits for the colours of the result."""
        self.window.click(*WRAP)
        self.window.xdotool("mousemove", "700", "120")

        def is_coloured():
            width, _, rgb = self.window.screen()
            right = np.frombuffer(rgb, np.uint8).reshape(-1, width, 3)[150:650, 850:].astype(int)
            return (np.ptp(right, axis=2) > 70).mean() > 0.03

        window.wait_for("the template shows its distances", is_coloured)
        self.window.settle()
        self.window.keep_picture(picture)

    def test_a_template_is_wrapped_onto_a_scan_and_takes_its_detail(self):
        animal, scan, places = self.open_with_scan()
        pairs = [  # the trunk, the head, a tusk, three feet, an ear and an eye
            ((784, 192), (1070, 207)), ((777, 375), (1100, 380)), ((586, 352), (1010, 370)),
            ((765, 500), (1200, 525)), ((535, 600), (990, 590)), ((665, 595), (1080, 595)),
            ((610, 500), (970, 485)), ((690, 385), (1043, 380)),
        ]  # fmt: skip
        for on_scan, on_template in pairs:
            self.window.click(*on_scan)
            self.window.click(*on_template)
        self.window.settle()
        self.window.keep_picture("pairs")
        self.wrap("wrapped")
        self.window.click(*COAT_DETAIL)
        self.window.wait_for_steps(1)
        self.window.keys("d", "i")
        self.window.drag((970, 520), (1000, 560), (1020, 570))
        self.window.settle()
        self.window.keep_picture("coat")
        self.window.keys("ctrl+Return")
        self.window.wait_for_steps(2)
        self.window.keep_picture("coated")
        glb, recipe, made = (self.folder / name for name in ("a.glb", "a.json", "a.obj"))
        self.window.save("ctrl+e", recipe)
        self.window.save("ctrl+s", glb)
        saved = lapwing.read(glb)
        steps = json.loads(recipe.read_text())["steps"]
        self.assertEqual([step["op"] for step in steps], ["wrap", "coat"])
        self.assertEqual(len(steps[0]["landmarks"]), len(pairs))
        subprocess.run([CLI, "run", recipe, "--save", made], check=True, capture_output=True)
        # A GLB file has its vertices in another order.
        run = np.sort(lapwing.read(made).vertices, axis=0)
        self.assertLess(np.abs(run - np.sort(saved.vertices, axis=0)).max(), SAME * diagonal(scan))
        del steps[1:]
        recipe.write_text(json.dumps({**json.loads(recipe.read_text()), "steps": steps}))
        subprocess.run([CLI, "run", recipe, "--save", made], check=True, capture_output=True)
        wrapped = lapwing.read(made)
        self.assertEqual(wrapped.vertex_count, animal.vertex_count)
        errors = np.linalg.norm(wrapped.vertices - places, axis=1) / diagonal(scan)
        self.assertLess(errors.mean(), 0.01)
        # The coat has finer triangles, and follows the scan between the template's vertices.
        old = {tuple(p) for p in np.round(wrapped.vertices / diagonal(scan), 4)}
        added = np.array([p for p in saved.vertices if tuple(np.round(p / diagonal(scan), 4)) not in old])
        self.assertGreater(len(added), 500)
        middle = added.mean(0)
        radius = 0.6 * np.linalg.norm(added - middle, axis=1).max()
        flat = lapwing.subdivide(wrapped, times=2).mesh.vertices

        def mean_height(points):
            near = np.linalg.norm(points - middle, axis=1) < radius
            return heights_over(scan, points[near]).mean() / diagonal(scan)

        self.assertLess(mean_height(added), 0.9 * mean_height(flat))

    def test_a_wrap_with_loaded_landmarks_is_cancelled_undone_and_survives_a_kill(self):
        _, scan, places = self.open_with_scan()
        rows = [[v, *places[v]] for v in range(0, len(places), 200)]
        np.savetxt(self.folder / "good.csv", rows, delimiter=",", header="vertex,x,y,z", comments="")
        rows[3][1:] = rows[3][1:] - 0.6 * diagonal(scan) * np.array([1, 0, 0])
        np.savetxt(self.folder / "bad.csv", rows, delimiter=",", header="vertex,x,y,z", comments="")
        self.answer(LOAD_LANDMARKS, self.folder / "bad.csv")
        self.wrap("contradiction")
        self.window.keys("ctrl+z")  # the loaded landmarks
        self.window.settle()
        self.answer(LOAD_LANDMARKS, self.folder / "good.csv")
        self.window.click(*WRAP)
        self.window.keys("Escape")
        self.window.settle()
        self.window.keep_picture("cancelled")
        self.assertEqual(self.window.draft()[0], [])
        self.wrap("wrapped")
        self.window.keys("ctrl+Return")
        self.window.wait_for_steps(1)
        self.window.keys("ctrl+z")
        self.window.wait_for_steps(0)
        self.window.keys("ctrl+shift+z")
        self.window.wait_for_steps(1)
        self.window.kill()
        self.restore()
        self.window.wait_for_steps(1)
        self.window.keep_picture("restored")
        wrapped, (step,) = self.save_and_run("wrapped")
        self.assertEqual((step["op"], len(step["landmarks"])), ("wrap", len(rows)))
        self.assertLess(np.linalg.norm(wrapped.vertices - places, axis=1).mean(), 0.005 * diagonal(scan))

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
