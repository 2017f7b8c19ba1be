"""Every glTF file of Debian's packages, and those of samples.py: what an edit leaves as it was, what
other programs read, and what the validator says."""

import copy
import json
import os
import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from scipy.spatial import cKDTree

import lapwing
import samples
from document import Document

MODELS = Path(os.environ["LAPWING_MODELS"]) / "assimp" / "models" / "glTF2"

#: Of Debian's files, those that no reader can take, with what is said of them.
REFUSED = {
    "IndexOutOfRange/AllIndicesOutOfRange.gltf": "names vertex 65535, but there are 24",
    "IndexOutOfRange/IndexOutOfRange.gltf": "names vertex 255, but there are 24",
    "MissingBin/BoxTextured.gltf": "there is no file 'BoxTextured0.bin'",
    "RecursiveNodes/RecursiveNodes.gltf": "its own ancestor",
    "SchemaFailures/sceneWrongType.gltf": "there is no file 'BoxTextured0.bin'",
    "draco/2CylinderEngine.gltf": "without compression",
    "wrongTypes/badArray.gltf": "expected a list, got an object",
}
#: Those without a triangle: of points and lines, or without a node.
EMPTY = {"TestNoRootNode/NoScene.gltf", "TestNoRootNode/SceneWithoutNodes.gltf"} | {
    f"glTF-Asset-Generator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_{k:02}.gltf"
    for k in (0, 1, 2, 3, 7, 8, 9, 10)
}
#: Unused accessors that reach beyond the buffer: once it has grown, the validator reads them.
SHORT = {"IncorrectVertexArrays/Cube.gltf"}
#: Coordinates that are no numbers, which an edit leaves alone.
NOT_FINITE = {"BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb"}


def name_of(path: Path) -> str:
    return str(path.relative_to(MODELS)) if MODELS in path.parents else path.name


def models():
    found = sorted(p for p in MODELS.rglob("*") if p.suffix.lower() in (".glb", ".gltf"))
    return found or [pytest.param(None, marks=pytest.mark.skip("no models"))]


def moved(points: np.ndarray, diagonal: float) -> np.ndarray:
    """A bend that turns every normal, by about a tenth of the mesh."""
    p = points / diagonal
    return diagonal * (p + 0.1 * np.stack([np.sin(3 * p[:, 1]), np.sin(2 * p[:, 2]), p[:, 0] ** 2], -1))


@pytest.fixture(scope="module")
def generated(tmp_path_factory):
    return {p.name: p for p in samples.write_all(tmp_path_factory.mktemp("samples"))}


def edit(path: Path, target: Path) -> float:
    mesh = lapwing.read(path)
    diagonal = float(np.linalg.norm(np.ptp(mesh.vertices, 0)))
    lapwing.write(target, mesh.with_vertices(moved(mesh.vertices, diagonal)))
    return diagonal


def without_bounds(text: bytes) -> bytes:
    """Of a document without further "min" and "max" all that an edit leaves as it was."""
    text = re.sub(rb'"(min|max)"\s*:\s*\[[^\]]*\]', b"", text)
    return re.sub(rb'"uri"\s*:\s*"[^"]*(\.bin"|;base64,[^"]*")', b"", text)


def expect_untouched(before: Document, after: Document) -> None:
    if len(after.json["accessors"]) == len(before.json["accessors"]):
        assert without_bounds(after.text) == without_bounds(before.text)
    else:
        expect_only_added(before.json, after.json)
    assert after.rest == before.rest
    touched = [np.zeros(len(b), bool) for b in before.buffers]
    for _, _, primitive in before.primitives():
        for attribute in ("POSITION", "NORMAL", "TANGENT"):
            if attribute not in primitive["attributes"]:
                continue
            for buffer, at, size in before.places(primitive["attributes"][attribute]):
                touched[buffer][at : at + size] = True
    for old, new, mask in zip(before.buffers, after.buffers, touched):
        # A mesh that shared its numbers, or had whole ones, got its own behind the others.
        assert len(new) == len(old) or len(after.json["accessors"]) > len(before.json["accessors"])
        kept = min(len(old), len(new))
        a, b, mask = np.frombuffer(old[:kept], "u1"), np.frombuffer(new[:kept], "u1"), mask[:kept]
        assert np.array_equal(a[~mask], b[~mask])


def expect_only_added(before, after) -> None:
    """The same document, but for numbers of accessors in attributes, and what stands behind."""
    before, after = copy.deepcopy(before), copy.deepcopy(after)
    for key in before:
        old, new = before[key], after[key]
        if key == "meshes":
            for m, n in zip(old, new):
                for p, q in zip(m["primitives"], n["primitives"]):
                    for name in ("POSITION", "NORMAL", "TANGENT"):
                        p["attributes"].pop(name, None), q["attributes"].pop(name, None)
            new = new[: len(old)]
        elif key == "nodes":
            # Nodes that shared a mesh have separate meshes after edits that make them differ.
            for m, n in zip(old, new):
                m.pop("mesh", None), n.pop("mesh", None)
        elif key == "accessors":
            new = new[: len(old)]
            for a, b in zip(old, new):
                a = {k: v for k, v in a.items() if k not in ("min", "max")}
                assert a == {k: v for k, v in b.items() if k not in ("min", "max")}
            continue
        elif key == "bufferViews":
            new = new[: len(old)]
        elif key == "buffers":
            continue
        assert new == old, key


def expect_moved(before: Document, after: Document, diagonal: float) -> None:
    tolerance = 1e-6 * diagonal
    for (_, matrix, old), (_, _, new) in zip(before.primitives(), after.primitives()):
        to_world = lambda p: p @ matrix[:3, :3].T + matrix[:3, 3]
        was = to_world(before.values(old["attributes"]["POSITION"]))
        now = to_world(after.values(new["attributes"]["POSITION"]))
        assert np.abs(now - moved(was, diagonal)).max() <= tolerance
        accessor = after.json["accessors"][new["attributes"]["POSITION"]]
        if "min" in accessor and not accessor.get("normalized"):
            stored = after.values(new["attributes"]["POSITION"])
            assert np.array_equal(np.float32(accessor["min"]), np.float32(stored.min(0)))
            assert np.array_equal(np.float32(accessor["max"]), np.float32(stored.max(0)))
        if "NORMAL" in new["attributes"]:
            normals = after.values(new["attributes"]["NORMAL"])
            lengths = np.linalg.norm(normals, axis=1)
            kept = np.all(normals == before.values(old["attributes"]["NORMAL"]), 1)
            assert np.all(kept | (np.abs(lengths - 1) < 1e-5))


def errors_of(validator: Path, path: Path) -> Counter:
    result = subprocess.run(
        ["node", str(validator), str(path)], capture_output=True, text=True, timeout=120
    )
    assert result.returncode == 0, result.stderr
    issues = json.loads(result.stdout)["issues"]["messages"]
    return Counter(issue["code"] for issue in issues if issue["severity"] == 0)


def check_file(path: Path, target: Path, validator: Path) -> None:
    name = name_of(path)
    if name in REFUSED:
        with pytest.raises(lapwing.Error, match=re.escape(REFUSED[name])):
            lapwing.read(path)
        return
    if name in EMPTY:
        assert lapwing.read(path).face_count == 0
        return
    before = Document(path)
    unmoved = target.with_name("unmoved" + path.suffix)
    lapwing.write(unmoved, lapwing.read(path))
    if before.binary:
        assert unmoved.read_bytes() == path.read_bytes()
    diagonal = edit(path, target)
    if name not in NOT_FINITE:
        expect_moved(before, Document(target), diagonal)
    expect_untouched(before, Document(target))
    for image in before.json.get("images", []):
        beside = path.parent / unquote(image.get("uri", ""))
        if "data:" not in str(beside) and beside.is_file():
            shutil.copy(beside, target.parent)
    added = errors_of(validator, target) - errors_of(validator, path)
    if name in NOT_FINITE:
        del added["ACCESSOR_INVALID_FLOAT"]  # each is counted, and they are in normals, too
    assert name in SHORT or not added, f"the validator's new errors: {added}"


@pytest.mark.parametrize("path", models(), ids=lambda p: name_of(p) if p else "none")
def test_a_file_of_the_packages(path, tmp_path, validator):
    check_file(path, tmp_path / ("edited" + path.suffix), validator)


@pytest.mark.parametrize(
    "name", [n + end for n in samples.ALL for end in (".glb", ".gltf", "-embedded.gltf")]
)
def test_a_generated_file(name, generated, tmp_path, validator):
    assert not errors_of(validator, generated[name]), "the sample itself is valid"
    check_file(generated[name], tmp_path / ("edited" + generated[name].suffix), validator)


def seen_by(assimp: str, path: Path, out: Path) -> np.ndarray:
    """The places of vertices as assimp reads them, none where it reads nothing."""
    subprocess.run([assimp, "export", str(path), str(out), "-ptv"], capture_output=True, timeout=120)
    if not out.exists():
        return np.zeros((0, 3))
    lines = (line.split() for line in out.read_text().splitlines() if line.startswith("v "))
    return np.array([[float(x) for x in words[1:4]] for words in lines]).reshape(-1, 3)


def largest_gap(a: np.ndarray, b: np.ndarray) -> float:
    """From a place of either list to the nearest of the other."""
    if not len(a) or not len(b):
        return np.inf
    gaps = lambda p, q: cKDTree(q).query(p)[0].max()
    return max(gaps(a, b), gaps(b, a))


@pytest.mark.parametrize("name", [n for n in samples.ALL if n not in ("quantized", "skinned")])
def test_another_program_reads_the_moved_positions(name, generated, tmp_path, assimp):
    target = tmp_path / "edited.glb"
    edit(generated[name + ".glb"], target)
    seen = seen_by(assimp, target, tmp_path / "seen.obj")
    assert len(seen)
    if name != "morphed":  # assimp shows the mesh as its weights have it
        assert largest_gap(seen, lapwing.read(target).vertices) < 1e-4


@pytest.mark.parametrize("path", models(), ids=lambda p: name_of(p) if p else "none")
def test_another_program_reads_a_file_of_the_packages(path, tmp_path, assimp):
    name = name_of(path)
    if name in REFUSED or name in EMPTY or name in NOT_FINITE:
        pytest.skip("it is not edited")
    original = lapwing.read(path)
    used = lambda mesh: mesh.vertices[np.unique(np.asarray(mesh.faces))]
    tolerance = 1e-4 * float(np.linalg.norm(np.ptp(original.vertices, 0)))
    if largest_gap(seen_by(assimp, path, tmp_path / "original.obj"), used(original)) > tolerance:
        pytest.skip("assimp sees the file itself elsewhere")
    target = tmp_path / ("edited" + path.suffix)
    edit(path, target)
    edited = lapwing.read(target)
    assert largest_gap(seen_by(assimp, target, tmp_path / "edited.obj"), used(edited)) < 2 * tolerance


def test_one_edit_of_an_obj_and_of_split_vertices_gives_one_surface(generated, tmp_path):
    split = lapwing.read(generated["plain.glb"])
    lapwing.write(tmp_path / "tube.obj", split)
    welded = lapwing.read(tmp_path / "tube.obj")
    z = split.vertices[:, 2]
    surfaces = [
        lapwing.deform(
            mesh, belt=z < 0.5, handles=[(z > 5.5, {"rotate": {"axis": [1, 0, 0], "degrees": 60}})]
        )
        for mesh in (split, welded)
    ]
    diagonal = np.linalg.norm(np.ptp(split.vertices, 0))
    assert np.abs(surfaces[0].vertices - surfaces[1].vertices).max() < 1e-6 * diagonal
    lapwing.write(tmp_path / "bent.glb", surfaces[0].mesh)
    document = Document(tmp_path / "bent.glb")
    (_, _, primitive), = document.primitives()
    points = document.values(primitive["attributes"]["POSITION"]).reshape(21, 17, 3)
    assert np.array_equal(points[:, 0], points[:, -1]), "the seam is closed"
    normals = document.values(primitive["attributes"]["NORMAL"]).reshape(21, 17, 3)
    assert np.array_equal(normals[:, 0], normals[:, -1]), "and its shading"
    from_file = lapwing.read(tmp_path / "bent.glb").vertices
    assert np.abs(from_file - surfaces[1].vertices).max() < 1e-6 * diagonal


def test_made_anew_the_validator_finds_nothing(tmp_path, validator):
    for name in ("tube", "sphere"):
        for suffix in (".glb", ".gltf"):
            path = tmp_path / (name + suffix)
            lapwing.write(path, lapwing.shape(name))
            assert not errors_of(validator, path)


def add_smile(path: Path, target: Path):
    """The upper half of the tube bent, saved as a morph target."""
    (target.parent / "smile.json").write_text(json.dumps({
        "lapwing": 1,
        "mesh": str(path),
        "steps": [{
            "op": "deform",
            "roi": {"box": {"min": [-9, -9, 2], "max": [9, 9, 9]}},
            "belt": {"box": {"min": [-9, -9, 2], "max": [9, 9, 3]}},
            "handles": [{
                "region": {"box": {"min": [-9, -9, 5.5], "max": [9, 9, 9]}},
                "move": {"translate": [1, 0, -0.25]},
            }],
        }],
        "save": target.name,
        "save_as": {"morph_target": "smile"},
    }))
    return lapwing.run(target.parent / "smile.json", save=True)


@pytest.mark.parametrize("name", ["plain", "two_materials", "interleaved", "morphed", "skinned"])
@pytest.mark.parametrize("suffix", [".glb", ".gltf", "-embedded.gltf"])
def test_an_edit_becomes_a_morph_target(name, suffix, generated, tmp_path, validator):
    source = generated[name + suffix]
    target = tmp_path / ("smiling" + source.suffix)
    result = add_smile(source, target)
    before, after = Document(source), Document(target)
    mesh = after.json["meshes"][0]
    old = len(before.json["meshes"][0]["primitives"][0].get("targets", []))
    assert mesh["extras"]["targetNames"][old:] == ["smile"]
    for primitive in mesh["primitives"]:
        assert len(primitive["targets"]) == old + 1
        base = after.values(primitive["attributes"]["POSITION"])
        smile = after.values(primitive["targets"][old]["POSITION"])
        gaps = np.abs((base + smile)[:, None, :] - result.vertices[None, :, :]).max(2).min(1)
        assert gaps.max() < 1e-5
        assert np.all(smile[base[:, 2] < 2] == 0)
    for old_bytes, new_bytes in zip(before.buffers, after.buffers):
        assert new_bytes[: len(old_bytes)] == old_bytes
    assert not errors_of(validator, target)
    assert np.array_equal(lapwing.read(target).vertices, lapwing.read(source).vertices)
    if name == "morphed":
        animation = after.json["animations"][0]["samplers"][0]
        assert after.values(animation["output"]).ravel().tolist() == [0, 0, 0, 1, 0.5, 0]
        with pytest.raises(lapwing.InputError, match="a morph target 'smile' already exists"):
            add_smile(target, tmp_path / ("again" + source.suffix))


def test_transferred_morph_targets_are_the_transfers_of_each_pose(generated, tmp_path, validator, assimp):
    source = generated["morphed.gltf"]
    target = tmp_path / "target.gltf"
    lapwing.write(target, lapwing.subdivide(lapwing.read(generated["plain.gltf"])).mesh)
    done = tmp_path / "done.gltf"
    subprocess.run([os.environ["LAPWING_CLI"], "transfer", source, "--morph-targets", "--onto", target,
                    "--aligned", "-o", done], check=True, capture_output=True)
    assert not errors_of(validator, done)
    rest, onto = lapwing.read(source), lapwing.read(target)
    assert np.array_equal(lapwing.read(done).vertices, onto.vertices)
    found = lapwing.read(done).morph_targets
    assert list(found) == list(rest.morph_targets) == ["wide", "long"]
    for name, pose in rest.morph_targets.items():
        alone = lapwing.transfer(rest, pose, onto, aligned=True).vertices
        assert np.abs(found[name] - alone).max() < 1e-6 * np.linalg.norm(np.ptp(alone, axis=0))
    # The module writes the same, and another program reads it. It writes targets without names.
    again, seen = tmp_path / "again.gltf", tmp_path / "seen.gltf"
    lapwing.write(again, onto, morph_targets=found)
    subprocess.run([assimp, "export", again, seen, "-fgltf2"], check=True, capture_output=True)
    for pose, other in zip(found.values(), lapwing.read(seen).morph_targets.values(), strict=True):
        assert largest_gap(pose, other) < 1e-4


def test_with_other_formats_a_morph_target_is_a_table(generated, tmp_path):
    lapwing.write(tmp_path / "tube.obj", lapwing.read(generated["plain.glb"]))
    before = (tmp_path / "tube.obj").read_bytes()
    result = add_smile(tmp_path / "tube.obj", tmp_path / "out.obj")
    assert (tmp_path / "out.obj").read_bytes() == before
    rest = lapwing.read(tmp_path / "out.obj").vertices
    assert np.array_equal(rest + np.load(tmp_path / "out-smile.npy"), result.vertices)
