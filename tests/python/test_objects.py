"""Results and meshes as Python objects: copies, pickles, what notebooks show, and messages."""

import copy
import json
import os
import pickle
import re
import signal
import subprocess
import sys

import numpy as np
import pytest

import lapwing
from conftest import run, turned
from lapwing import _core


@pytest.fixture(scope="module")
def bent(tube, ends):
    return lapwing.deform(tube, belt=ends[0], handles=[(ends[1], turned(60.0))])


def same(one, other):
    """Whether two values are equal, bit for bit and at any depth."""
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and np.array_equal(one, other)
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, (lapwing.Mesh, lapwing.Result, lapwing.Certificate)):
        names = [name for name in dir(one) if not name.startswith("_") and name != "with_vertices"]
        return all(same(getattr(one, name), getattr(other, name)) for name in names)
    return one == other


def pickled(value):
    return pickle.loads(pickle.dumps(value))


@pytest.mark.parametrize("clone", [copy.copy, copy.deepcopy, pickled])
def test_meshes_and_results_have_equal_copies(tube, ends, bent, clone):
    many = lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]]).solve_many([[turned(5.0)]])
    for value in (tube, bent, bent.certificate, many):
        assert same(value, clone(value)) and repr(clone(value)) == repr(value)
    for made in (lapwing.peel(tube, detail_size=0.5), lapwing.remesh(tube, scale=2.0), lapwing.fix(tube)):
        other = clone(made)
        assert all(same(value, getattr(other, name)) for name, value in vars(made).items())


OBJ = """mtllib a.mtl
# a comment
v 0 0 0 1 0 0
v 1 0 0 0 1 0
v 1 1 0 0 0 1
v 0 1 0 1 1 1
vt 0 0
vt 1 1
vn 0 0 1
g caf\xe9
usemtl red
f 1/1/1 2/2/1 3/2/1
usemtl blue
f 1/1/1 3/2/1 4/1/1
"""
PLY = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
property float quality
element face 1
property list uchar int vertex_indices
property uchar red
property uchar green
property uchar blue
end_header
0 0 0 0.5
1 0 0 0.25
0 1 0 8
3 0 1 2 255 0 255
"""


@pytest.mark.parametrize("name, text", [("a.obj", OBJ), ("a.ply", PLY)])
def test_a_pickled_mesh_keeps_what_its_file_says_of_it(tmp_path, name, text):
    (tmp_path / name).write_bytes(text.encode("latin-1"))
    mesh = lapwing.read(tmp_path / name)
    lapwing.write(tmp_path / f"file-{name}", mesh.with_vertices(2.0 * mesh.vertices))
    lapwing.write(tmp_path / f"pickle-{name}", pickled(mesh.with_vertices(2.0 * mesh.vertices)))
    words = [sorted(re.split(rb"\s+", (tmp_path / f"{kind}-{name}").read_bytes())) for kind in ("file", "pickle")]
    for wanted in (b"usemtl", b"blue", b"vt", b"vn", b"caf\xe9", b"a.mtl") if name == "a.obj" else (b"quality",):
        assert wanted in words[1]
    again = lapwing.read(tmp_path / f"pickle-{name}")
    assert (again.vertices == 2.0 * mesh.vertices).all() and (again.faces == mesh.faces).all()


def test_a_damaged_pickle_is_refused(tube):
    constructor, arguments, state = tube.__reduce_ex__(2)[:3]
    for wrong in (state[:1] + (b"123",) + state[2:], state[:2] + (state[2][:-4],) + state[3:],
                  (b"",) + state[1:]):
        with pytest.raises(lapwing.InputError):
            constructor(*arguments).__setstate__(wrong)


def test_a_prepared_edit_of_a_textured_mesh_keeps_the_texture(tmp_path):
    (tmp_path / "a.obj").write_bytes(OBJ.encode("latin-1"))
    edit = lapwing.Deformer(lapwing.read(tmp_path / "a.obj"), belt=[0], handles=[[2]])
    lapwing.write(tmp_path / "b.obj", pickled(edit).solve(np.eye(4)))
    assert b"vt 1 1" in (tmp_path / "b.obj").read_bytes()


def test_a_result_is_two_arrays_and_says_what_it_is(bent, tube):
    V, F = bent
    assert (V == bent.vertices).all() and (F == tube.faces).all()
    V, F = lapwing.fix(V, F)
    assert len(V) == tube.vertex_count
    assert repr(bent).startswith(f"Result({tube.vertex_count} vertices, {tube.face_count} faces")
    hurried = lapwing.deform(
        tube, handles=[(bent.handles[0], turned(170.0))], settle={"max_iterations": 1}
    )
    assert "not settled" in repr(hurried) and f"{len(hurried.warnings)} warning" in repr(hurried)


def test_notebooks_show_a_picture(bent, tube):
    for shown in (bent, tube):
        assert shown._repr_png_().startswith(b"\x89PNG\r\n")


def test_notebooks_show_text_without_vulkan(tube):
    bare = {**os.environ, "VK_ICD_FILENAMES": "/nowhere.json", "VK_DRIVER_FILES": "/nowhere.json"}
    told = run([sys.executable, "-c",
                "import lapwing; print(lapwing.shape('sphere')._repr_png_())"], env=bare)
    assert told.strip() == "None"


def test_the_module_runs_recipes_and_prints_keys(tmp_path):
    lapwing.write(tmp_path / "tube.off", lapwing.shape("tube"))
    (tmp_path / "bend.json").write_text(
        '{"lapwing": 1, "mesh": "tube.off", "save": "out.off", "steps": [{"op": "deform", '
        '"roi": {"all": true}, "handles": [{"region": {"vertices": [5]}, "move": {}}]}]}'
    )
    command = [sys.executable, "-m", "lapwing"]
    assert run([*command, "run", "bend.json"], cwd=tmp_path).startswith("Result(")
    assert (tmp_path / "out.off").exists()
    assert run([*command, "keys", "peel"]) == lapwing.keys("peel") + "\n"
    assert run([*command, "--version"]).strip() == f"lapwing {_core.__version__}"
    failed = subprocess.run([*command, "run", tmp_path / "none.json"], capture_output=True, text=True, check=False)
    assert failed.returncode == 1 and failed.stderr.startswith("error: ") and "none.json" in failed.stderr


def test_a_forked_child_computes_the_same_and_ends(bent, tube, ends):
    # A forked child has no pool threads, but it must compute the same results as its parent.
    edit = lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]])
    expected = edit.solve(turned(60.0)).vertices
    child = os.fork()
    if child == 0:
        signal.alarm(60)  # ends a child that hangs
        equal = (edit.solve(turned(60.0)).vertices == expected).all()
        del edit
        again = lapwing.deform(tube, belt=ends[0], handles=[(ends[1], turned(60.0))]).vertices
        os._exit(0 if equal and (again == expected).all() else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_a_forked_child_exits_through_the_interpreter():
    told = subprocess.run(
        [sys.executable, "-c",
         "import lapwing, os\n"
         "lapwing.remesh(lapwing.shape('sphere'), scale=1.5)\n"
         "lapwing.deform(lapwing.shape('tube'), handles=[([5], {'translate': [0, 0, 0.1]})])\n"
         "child = os.fork()\n"
         "if child: print(os.waitpid(child, 0)[1])\n"],
        capture_output=True, text=True, timeout=60, check=True,
    )
    assert told.stdout == "0\n"


PHRASES = {
    "deform: /handles/0/region: it is empty": "deform: handles[0].region: it is empty",
    "Deformer: /handles/12/region/vertices/3: no": "Deformer: handles[12].region.vertices[3]: no",
    "peel: region: /disk/radius: expected": "peel: region.disk.radius: expected",
    "transplant: /part/region: empty": "transplant: part_region: empty",
    "recipe: /steps/0/roi: empty": "recipe: /steps/0/roi: empty",
    "/home/a/b.obj:2: expected": "/home/a/b.obj:2: expected",
    "repair it with `lapwing check MESH --fix OUT`": "repair it with `lapwing.fix`",
    "fill them with `lapwing check MESH --fix OUT --fill-holes smooth`": "fill them with `lapwing.fill_holes`",
    "run `lapwing check` first": "run `lapwing.check` first",
    "remesh the patch with `lapwing remesh`": "remesh the patch with `lapwing.remesh`",
    "close programs, or run with --device cpu": 'close programs, or use device="cpu"',
    'add "commit_every": 90 (or --commit-every 90)': 'add "commit_every": 90',
}


@pytest.mark.parametrize("message", PHRASES)
def test_messages_speak_of_python(message):
    assert _core._in_python_words(message) == PHRASES[message]


def test_messages_of_the_engine_name_no_program_and_no_flag(source):
    literal = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
    only_of_the_command_line = {"batch", "recipe_files.cpp", "part_library.cpp", "child_process.cpp", "video_writer.cpp"}
    for file in sorted((source / "engine" / "lapwing").rglob("*.cpp")):
        if only_of_the_command_line & {file.name, file.parent.name}:
            continue
        code = "\n".join(line for line in file.read_text().splitlines() if "#include" not in line)
        code = re.sub(r'"\s*\n\s*"', "", code)
        for text in literal.findall(code):
            # The engine appends a number and a closing parenthesis to this text.
            if text.startswith(" (or --"):
                text += "90)"
            if text.endswith("`--device "):
                text += "0`"
            told = _core._in_python_words(text.replace('\\"', '"'))
            assert not re.search(r"`lapwing [a-z]|(^|[ `(])--[a-z]", told), f"{file.name}: {told}"
            for name in re.findall(r"`lapwing\.(\w+)`", told):
                assert hasattr(lapwing, name), f"{file.name}: {told}"


def test_errors_and_warnings_reach_python_in_its_words(tube, ends):
    with pytest.raises(lapwing.InputError, match=r"deform: handles\[0\].region.disk: "):
        lapwing.deform(tube, handles=[({"disk": {"center": 1}}, np.eye(4))])
    with pytest.raises(lapwing.DeviceError, match='device="cpu"'):
        lapwing.deform(tube, handles=[(ends[1], np.eye(4))], device="no such device")
    repeated = lapwing.check([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2], [0, 1, 2]])
    assert all("lapwing check" not in defect.next_step for defect in repeated.defects)
    assert any("`lapwing.fix`" in defect.next_step for defect in repeated.defects)


def test_a_note_says_why_a_software_device_is_not_used(tube, ends):
    result = lapwing.deform(tube, handles=[(ends[1], np.eye(4))], device="auto")
    on_gpu = "The CPU computes" not in " ".join(result.notes)
    assert on_gpu or "`--device" not in " ".join(result.notes)
    cpu = lapwing.deform(tube, handles=[(ends[1], np.eye(4))], device="cpu")
    assert on_gpu or (result.vertices == cpu.vertices).all()


def test_reading_warns_of_objects_that_are_left_out(tube, tmp_path):
    lapwing.write(tmp_path / "a.gltf", tube)
    document = json.loads((tmp_path / "a.gltf").read_text())
    document["nodes"].append({"mesh": 0, "name": "hidden", "scale": [0, 0, 0]})
    document["scenes"][0]["nodes"].append(1)
    (tmp_path / "a.gltf").write_text(json.dumps(document))
    with pytest.warns(UserWarning, match="'hidden' has a scale of 0") as caught:
        assert lapwing.read(tmp_path / "a.gltf").vertex_count == tube.vertex_count
    assert caught[0].filename == __file__
