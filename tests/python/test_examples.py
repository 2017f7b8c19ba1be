"""The examples and the README's lines, as a user runs them."""

import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import lapwing
from conftest import run


@pytest.fixture
def example(source, tmp_path):
    def start(name, *arguments):
        script = source / "tools" / "python" / "examples" / name
        return run([sys.executable, script, *arguments], cwd=tmp_path)

    return start


def test_landmarks_onto_a_template(example, scan, scan_file, tmp_path):
    # A scan that is turned, larger, elsewhere and bent: landmarks of it are known.
    bent = lapwing.deform(
        scan,
        roi={"disk": {"center": 969, "radius": 72}},
        handles=[({"disk": {"center": 969, "radius": 27}}, {"translate": [-5, 13, 2]})],
    ).vertices
    places = 2.5 * bent[:, [1, 2, 0]] + [100.0, 0.0, -30.0]
    vertices = np.arange(0, scan.vertex_count, 400)
    rows = np.column_stack([vertices, places[vertices]])
    np.savetxt(tmp_path / "landmarks.csv", rows, delimiter=",", fmt=["%d", "%r", "%r", "%r"])
    told = example("landmarks.py", scan_file, "landmarks.csv", "fitted.ply", "--hard")
    fitted = lapwing.read(tmp_path / "fitted.ply")
    assert np.abs(fitted.vertices[vertices] - places[vertices]).max() < 1e-6, told
    # Between the landmarks, too, the surface is where it should be: within a mean edge.
    assert np.linalg.norm(fitted.vertices - places, axis=1).mean() < 2.5, told


def test_a_coat_from_another_mesh(example, tmp_path):
    lapwing.write(tmp_path / "source.obj", lapwing.remesh(lapwing.shape("bumpy-plane"), scale=3.0))
    lapwing.write(tmp_path / "target.obj", lapwing.shape("sphere"))
    told = example("coat.py", "source.obj", "target.obj", "coated.obj", "--picture", "coat.png",
                   "--source-vertex", "1500", "--radius", "0.2")
    assert int(told.split()[-3]) > 100
    assert np.isfinite(lapwing.read(tmp_path / "coated.obj").vertices).all()
    assert (tmp_path / "coat.png").stat().st_size > 10_000


def test_a_data_set(example, scan_file, tmp_path):
    example("data_set.py", scan_file, "arms.npz", "--center", "969", "--radius", "72",
            "--count", "12")
    arms = np.load(tmp_path / "arms.npz")
    assert arms["displacements"].shape == (12, 26002, 3) and arms["settled"].all()
    moved = np.abs(arms["displacements"]).max(axis=(1, 2))
    assert (moved > 1.0).all() and len(set(moved)) == 12


def test_a_shape_model_of_wrapped_scans(example, tmp_path):
    # Scans of ellipsoids with two axes of random lengths, and with other triangles each.
    ball = lapwing.shape("sphere")
    lapwing.write(tmp_path / "template.ply", lapwing.decimate(ball, share=0.03))
    rng = np.random.default_rng(5)
    lines = [{"id": "missing", "set": {"/steps/0/scan": "none.ply"}}]
    for k in range(8):
        scan = lapwing.decimate(ball, share=0.05 + 0.01 * k).mesh
        lapwing.write(
            tmp_path / f"{k}.ply",
            scan.with_vertices(scan.vertices * [1.0, *rng.uniform(1.2, 1.8, 2)]),
        )
        lines.append({"id": f"scan-{k}", "set": {"/steps/0/scan": f"{k}.ply"}})
    (tmp_path / "jobs.jsonl").write_text("\n".join(map(json.dumps, lines)))
    (tmp_path / "wrap.json").write_text(json.dumps(
        {"lapwing": 1, "mesh": "template.ply", "steps": [{"op": "wrap", "scan": "", "aligned": True}]}
    ))
    batch = [os.environ["LAPWING_CLI"], "batch", "jobs.jsonl", "--recipe", "wrap.json", "-o",
             "wrapped", "--vertices", "vertices.npy"]
    done = subprocess.run(batch, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 3 and "1 job failed" in done.stderr, done.stderr
    told = example("shape_model.py", "vertices.npy", "wrapped", "model.npz", "--picture", "modes.png")
    assert "8 shapes of 9 jobs; 2 modes have 95%" in told
    model = np.load(tmp_path / "model.npz")
    assert model["ids"].tolist() == [f"scan-{k}" for k in range(8)]
    vertices = np.load(tmp_path / "vertices.npy")
    assert vertices.shape == (9, *model["mean"].shape) and np.isnan(vertices[0]).all()
    modes = model["modes"].reshape(len(model["modes"]), -1)
    assert np.allclose(modes @ modes.T, np.eye(len(modes)))
    assert np.allclose(model["scores"].std(axis=0, ddof=1), model["deviations"])
    assert (tmp_path / "modes.png").stat().st_size > 10_000


def test_a_notebook_with_pictures(example, tmp_path):
    example("notebook.py", "turned.png")
    assert (tmp_path / "turned.png").stat().st_size > 10_000


def test_the_lines_of_the_readme(source, scan_file, tmp_path, monkeypatch):
    (tmp_path / "armadillo.off").symlink_to(scan_file)
    monkeypatch.chdir(tmp_path)
    readme = "".join(
        (source / page).read_text() for page in ("README.md", "tools/python/README.md")
    )
    blocks = re.findall(r"```python\n(.*?)```", readme, re.S)
    assert len(blocks) >= 3
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
    assert lapwing.read(tmp_path / "raised.obj").vertex_count == 26002


def test_the_types_hold(source, tmp_path):
    folder = source / "tools" / "python"
    run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", tmp_path, folder / "lapwing"])


def test_the_stub_names_all_that_the_extension_has(source):
    import ast

    from lapwing import _core

    stub = ast.parse((source / "tools" / "python" / "lapwing" / "_core.pyi").read_text())
    written = {
        node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))
    }
    there = {name for name in vars(_core) if not name.startswith("_")}
    assert there == set(written)
    for name, node in written.items():
        if not isinstance(node, ast.ClassDef) or issubclass(getattr(_core, name), Exception):
            continue
        members = {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
        own = {each for each in vars(getattr(_core, name)) if not each.startswith("_")}
        assert own == {each for each in members if not each.startswith("_")}, name
