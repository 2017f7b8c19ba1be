"""A deform from Python: its values, and that it is the command line's."""

import inspect
import os
import re
import signal
import subprocess
import sys
import threading
import time
import typing

import numpy as np
import pytest

import lapwing
from conftest import ARM, HAND, run, turned
from lapwing import _core


def test_a_still_handle_keeps_every_bit(tube, ends):
    result = lapwing.deform(tube, belt=ends[0], handles=[(ends[1], np.eye(4))])
    assert (result.vertices == tube.vertices).all()
    assert (result.rotations == np.eye(3)).all()


def test_a_turn_of_all_that_is_held_turns_the_surface(tube, ends):
    both = turned(40.0, [1.0, 2.0, 3.0])
    result = lapwing.deform(tube, belt=[], handles=[(ends[0], both), (ends[1], both)])
    expected = tube.vertices @ both[:3, :3].T + both[:3, 3]
    assert np.abs(result.vertices - expected).max() < 1e-6
    assert np.abs(result.rotations - both[:3, :3]).max() < 1e-4


def test_regions_are_masks_lists_or_those_of_recipes(tube, ends):
    move = turned(20.0)
    mask = np.isin(np.arange(tube.vertex_count), ends[1])
    results = [
        lapwing.deform(tube, belt=ends[0], handles=[(hand, move)]).vertices
        for hand in (mask, ends[1], ends[1].tolist(), {"vertices": ends[1]})
    ]
    for other in results[1:]:
        assert (other == results[0]).all()


def test_targets_are_rows_a_dict_or_landmarks(tube, ends):
    place = tube.vertices[ends[1][0]] + [0.3, 0.0, 0.1]
    rows = np.array([[ends[1][0], *place]])
    by_rows = lapwing.deform(tube, belt=ends[0], targets=rows)
    by_dict = lapwing.deform(tube, belt=ends[0], targets={ends[1][0]: place})
    by_pair = lapwing.deform(tube, belt=ends[0], landmarks=(ends[1][:1], [place]))
    assert (by_rows.vertices == by_dict.vertices).all()
    assert (by_rows.vertices == by_pair.vertices).all()
    edit = lapwing.Deformer(tube, belt=ends[0], landmarks=(ends[1][:1], [place]))
    assert (edit.solve(np.zeros((0, 4, 4))).vertices == by_pair.vertices).all()
    assert by_rows.certificate.target_error < 0.3


def test_stiffness_is_an_array_or_parts(tube, ends):
    bone = np.ones(tube.vertex_count)
    middle = np.abs(tube.vertices[:, 2] - tube.vertices[:, 2].mean()) < 0.5
    bone[middle] = np.inf
    move = turned(40.0)
    edit = dict(belt=ends[0], handles=[(ends[1], move)])
    by_array = lapwing.deform(tube, stiffness=bone, **edit)
    by_parts = lapwing.deform(tube, stiffness=[{"region": middle, "factor": np.inf}], **edit)
    assert (by_array.vertices == by_parts.vertices).all()
    rest = tube.vertices[middle] - tube.vertices[middle].mean(axis=0)
    now = by_array.vertices[middle] - by_array.vertices[middle].mean(axis=0)
    assert np.allclose(rest @ rest.T, now @ now.T, atol=1e-3), "the part has moved as one body"
    edit_once = lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]], stiffness=bone)
    assert (edit_once.solve([move]).vertices == by_array.vertices).all()
    with pytest.raises(lapwing.InputError, match="expected a factor for each of the"):
        lapwing.deform(tube, stiffness=bone[1:], **edit)
    bone[3] = 0.0
    with pytest.raises(lapwing.InputError, match="expected a factor from 0.01 to 100"):
        lapwing.deform(tube, stiffness=bone, **edit)


def test_a_landmarks_weight_of_a_tenth_averages_noise(scan):
    # These are the numbers in tools/python/README.md for a noise of 0.5% of the diagonal.
    move = {"translate": [-5, 13, 2], "rotate": {"axis": [0, 0, 1], "degrees": 35}}
    true = lapwing.deform(scan, roi=ARM, handles=[(HAND, move)]).vertices
    diagonal = np.linalg.norm(np.ptp(scan.vertices, axis=0))
    ids = np.arange(0, scan.vertex_count, 100)
    noise = np.random.default_rng(1).normal(scale=0.005 * diagonal / np.sqrt(3), size=(len(ids), 3))

    def error(weight, places):
        rows = np.column_stack([ids, places, np.full(len(ids), weight)])
        found = lapwing.deform(scan, belt=[], targets=rows).vertices
        return np.sqrt(np.square(found - true).sum(axis=1).mean())

    noisy = [error(weight, true[ids] + noise) for weight in (1.0, 0.1, 0.01)]
    assert noisy[1] < 0.8 * noisy[0] and noisy[1] < 0.8 * noisy[2]
    assert error(1.0, true[ids]) < error(0.1, true[ids])


def test_one_edit_has_the_same_bits_from_python_and_from_the_command_line(
    scan_file, scan, cli, tmp_path
):
    save = tmp_path / "raised.off"
    run([cli, "deform", scan_file, "--roi", "disk:969,72", "--handle", "disk:969,27",
         "--translate=-5,13,2", "--rotate", "0,0,1,35", "--device", "cpu", "--save", save])
    move = {"translate": [-5, 13, 2], "rotate": {"axis": [0, 0, 1], "degrees": 35}}
    result = lapwing.deform(scan, roi=ARM, handles=[(HAND, move)])
    assert (result.vertices == lapwing.read(save).vertices).all()
    assert result.certificate.settled and result.warnings == []


def test_polygons_and_what_a_file_has_come_back(tmp_path):
    (tmp_path / "a.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
        "vt 0 0\nvt 1 1\nf 1/1 2/1 3/2 4/2\nf 2/1 5/1 6/2\nf 2/1 6/2 3/2\n"
    )
    mesh = lapwing.read(tmp_path / "a.obj")
    result = lapwing.deform(mesh, belt=[0, 3], handles=[([4, 5], {"translate": [0, 0, 0.5]})])
    assert [len(face) for face in result.faces] == [4, 3, 3]
    assert lapwing.write(tmp_path / "b.obj", result) == []
    assert "vt 1 1" in (tmp_path / "b.obj").read_text()


def rows_of(op):
    """The keys of an operation with the values of each."""
    rows = (line.split("|") for line in lapwing.keys(op).splitlines() if line.startswith("| `"))
    return {row[1].strip(" `"): row[2] for row in rows}


def test_every_key_of_an_operation_is_a_parameter():
    for op in _core.operations():
        parameters = inspect.signature(getattr(lapwing, op)).parameters
        keys = rows_of(op).keys()
        for key in keys - {"carry"}:
            if "." not in key:
                assert key in parameters, f"{op} has no parameter {key}"


def test_every_parameter_is_in_the_docstring():
    for name in ("deform", "coat", "mix", "transplant", "peel", "remesh", "parameterize", "run",
                 "check", "fix", "fill_holes", "decimate", "subdivide", "render", "read", "write", "shape", "Deformer"):
        function = getattr(lapwing, name)
        told = set(re.findall(r"[A-Za-z_]\w*", function.__doc__))
        for parameter in set(inspect.signature(function).parameters) - {"mesh", "faces", "path", "name"}:
            assert parameter in told, f"{name}: {parameter}"


def test_the_types_of_keywords_name_all_choices():
    from lapwing import _types

    types = {key: hint for key, hint in vars(_types).items() if typing.get_origin(hint) is typing.Literal}
    names = {"weights": "Weights", "response": "LinearResponse", "loose": "Loose", "seams": "Seams",
             "domain": "Domain", "sampling": "Sampling", "take": "Take", "profile": "Profile",
             "remesh": "Remesh"}
    seen = set()
    for op in _core.operations():
        for key, values in rows_of(op).items():
            if key in names:
                choices = set(re.findall(r'"(\w+)"', values))
                assert set(typing.get_args(types[names[key]])) == choices, f"{op}: {key}"
                seen.add(key)
    assert seen == set(names)
    assert set(typing.get_args(types["Operation"])) == set(_core.operations())


def test_keys_of_all_operations_are_listed():
    assert "`detail_length`" in lapwing.keys("deform") and "`snap`" not in lapwing.keys("deform")
    assert all(lapwing.keys(op) in lapwing.keys() for op in _core.operations())
    with pytest.raises(lapwing.InputError, match='unknown operation "bend"; choose one of deform, '):
        lapwing.keys("bend")


def test_keys_end_silently_when_their_output_is_closed():
    keys = subprocess.Popen([sys.executable, "-m", "lapwing", "keys"], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE)
    keys.stdout.close()
    assert keys.stderr.read() == b""
    keys.stderr.close()
    assert keys.wait() == -signal.SIGPIPE


def test_progress_is_told_and_can_cancel(scan):
    stages = []
    lapwing.deform(
        scan, handles=[(HAND, turned(30.0))], progress=lambda stage, share: stages.append(stage)
    )
    assert stages
    with pytest.raises(lapwing.Error, match="cancelled"):
        lapwing.deform(scan, handles=[(HAND, turned(30.0))], progress=lambda *_: False)


def test_an_error_in_progress_comes_out(scan):
    def fail(stage, share):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        lapwing.deform(scan, handles=[(HAND, turned(30.0))], progress=fail)


def test_ctrl_c_cancels(scan):
    deformer = lapwing.Deformer(scan, roi=ARM, handles=[HAND])
    motions = np.tile(turned(30.0), (1000, 1, 1, 1))
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        deformer.solve_many(motions)
    timer.join()


def test_python_goes_on_while_the_engine_computes(scan):
    # Were the lock held, the other thread would wake once after the call, not during it.
    done = threading.Event()
    woken = 0

    def compute():
        lapwing.deform(scan, handles=[(HAND, turned(60.0))])
        done.set()

    thread = threading.Thread(target=compute)
    thread.start()
    while not done.is_set():
        time.sleep(0.001)
        woken += 1
    thread.join()
    assert woken > 3


def test_eight_threads_are_inside_at_once_and_right(scan):
    inside = threading.Barrier(8, timeout=120)

    def solve(k, results, progress=None):
        move = turned(5.0 * (k + 1))
        results[k] = lapwing.deform(scan, roi=ARM, handles=[(HAND, move)], progress=progress).vertices

    alone, together = [None] * 8, [None] * 8
    for k in range(8):
        solve(k, alone)
    waited = [False] * 8

    def meet_first(k):
        def progress(stage, share):
            if not waited[k]:
                waited[k] = True
                inside.wait()

        return progress

    threads = [threading.Thread(target=solve, args=(k, together, meet_first(k))) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(waited)
    for one, other in zip(alone, together):
        assert (one == other).all()
