"""The other operations, and recipes, on arrays."""

import json
import os

import numpy as np
import pytest

import lapwing
from conftest import run, turned


@pytest.fixture(scope="module")
def sheet():
    """A square of 21 x 21 vertices with hills."""
    return lapwing.remesh(lapwing.shape("bumpy-plane"), scale=4.0).mesh


def test_peel_takes_off_what_puts_the_surface_back(sheet):
    peeled = lapwing.peel(sheet, detail_size=0.2)
    assert np.abs(peeled.vertices + peeled.coating - sheet.vertices).max() < 1e-12
    assert peeled.mean_coating > 0.0 and peeled.moved.size > 0


def test_remesh_and_parameterize(sheet):
    finer = lapwing.remesh(sheet, scale=0.5)
    assert finer.mesh.vertex_count > 3 * sheet.vertex_count
    flat = lapwing.parameterize(finer.mesh, domain="square")
    assert len(flat.points) >= flat.patch_vertices.size and flat.patch_faces.max() < len(flat.points)
    assert flat.points.min() >= 0.0 and flat.points.max() <= 1.0 and flat.flipped.size == 0


def test_a_coat_of_its_own_detail_changes_little(sheet):
    middle = {"disk": {"near": [0.5, 0.5, 0.0], "radius": 0.4}}
    coated = lapwing.coat(
        sheet, target_patch=middle, source_patch=middle, detail_size=0.1, smooth_target=0.1,
        remesh="none",
    )
    assert coated.mesh.vertex_count == sheet.vertex_count
    assert np.abs(coated.vertices - sheet.vertices).max() < 0.1


def test_a_coat_from_another_mesh_is_that_of_the_command_line(sheet, cli, tmp_path):
    source = lapwing.remesh(lapwing.shape("bumpy-plane"), scale=3.0).mesh
    lapwing.write(tmp_path / "target.off", sheet)
    lapwing.write(tmp_path / "source.off", source)
    run([cli, "coat", tmp_path / "target.off", "--source", tmp_path / "source.off",
         "--target-patch", "all", "--detail-size", "0.1", "--no-remesh", "--device", "cpu",
         "--save", tmp_path / "coated.off"])
    coated = lapwing.coat(sheet, source, target_patch="all", detail_size=0.1, remesh="none")
    assert (coated.vertices == lapwing.read(tmp_path / "coated.off").vertices).all()


def test_a_mix_by_a_painted_share(sheet):
    share = np.linspace(0.0, 1.0, sheet.vertex_count)
    other = lapwing.remesh(lapwing.shape("bumpy-plane"), scale=3.0).mesh
    mixed = lapwing.mix(
        sheet,
        [{"patch": "all", "detail_size": 0.1}, {"mesh": other, "patch": "all", "detail_size": 0.1}],
        target_patch="all", weight=share, remesh="none",
    )
    assert np.isfinite(mixed.vertices).all()
    with pytest.raises(lapwing.InputError, match=r"sources\[0\]: expected a dict"):
        lapwing.mix(sheet, [sheet, other], target_patch="all", weight=share)


def test_a_transplant_has_the_hosts_vertices_first():
    host = lapwing.shape("sphere")
    part = lapwing.shape("torus")
    hole = {"disk": {"near": [0, 0, 2], "radius": 0.5}}
    piece = {"disk": {"near": [9, 0, 0], "radius": 0.3}}
    joined = lapwing.transplant(host, part, target_region=hole, part_region=piece)
    kept = [v.tolist() for v in host.vertices if v[2] < 0.0]
    assert [v.tolist() for v in joined.vertices[: len(host.vertices)] if v[2] < 0.0] == kept
    assert lapwing.check(joined).statistics["boundary_loops"] == 0
    with pytest.raises(lapwing.InputError, match="give a part, a part_region"):
        lapwing.transplant(host, target_region=hole)


def vase(sides=48, rings=81):
    """Returns a tube of radius 1 about the z axis that widens to radius 6 between z = 20 and 24."""
    z, angle = (a.ravel() for a in np.meshgrid(
        np.linspace(0.0, 40.0, rings), np.arange(sides) * 2 * np.pi / sides, indexing="ij"))
    radius = 1.0 + 5.0 * np.clip((z - 20.0) / 4.0, 0.0, 1.0)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij"))
    k = (j + 1) % sides
    low = i * sides
    faces = np.stack([low + j, low + k, low + sides + k, low + sides + j], axis=1)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1), faces


def test_a_grabbed_region_ends_where_the_limb_joins_the_body():
    V, F = vase()
    tip = int(np.argmin(np.linalg.norm(V - [1.0, 0.0, 2.0], axis=1)))
    grab = lapwing.grab_region((V, F), tip, 2.5)
    assert grab.is_limb and grab.radius == pytest.approx(18.0, abs=2.0)
    assert V[grab.vertices][:, 2].max() < 24.0
    assert set(np.flatnonzero(V[:, 2] == 0.0)) <= set(grab.vertices), "the rim is cut off"
    half = lapwing.grab_region(V, tip, 2.5, faces=F, factor=0.5)
    assert half.radius == pytest.approx(0.5 * grab.radius)
    hand = {"disk": {"center": tip, "radius": 1.0}}
    result = lapwing.deform(V, F, roi=grab.vertices, handles=[(hand, {"translate": [3, 0, 0]})])
    assert result.vertices[tip, 0] - V[tip, 0] == pytest.approx(3.0, abs=0.05)
    outside = np.setdiff1d(np.arange(len(V)), grab.vertices)
    np.testing.assert_array_equal(result.vertices[outside], V[outside])


def test_a_grab_needs_a_vertex_and_a_radius(sheet):
    for vertex, radius, words in ((10**6, 1.0, "belongs to no triangle"), (0, -1.0, "positive"),
                                  (-1, 1.0, "vertex number from 0")):
        with pytest.raises(lapwing.InputError, match=words):
            lapwing.grab_region(sheet, vertex, radius)


def test_a_template_is_wrapped_onto_a_scan():
    template = lapwing.shape("sphere")
    V = np.array(template.vertices)
    scan = lapwing.subdivide(template).mesh
    placed = np.array(scan.vertices) * [1.0, 1.2, 1.5]
    wrapped = lapwing.wrap(template, placed, scan_faces=scan.faces, aligned=True)
    assert wrapped.mesh.vertex_count == len(V) and not wrapped.trouble
    assert wrapped.to_scan.mean < 0.01 and wrapped.coverage > 0.99
    corners = [int(np.argmax(V @ axis)) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
    by_landmarks = lapwing.wrap(
        template, placed, {c: V[c] * [1.0, 1.2, 1.5] for c in corners}, scan_faces=scan.faces
    )
    assert by_landmarks.landmark_error < 0.01
    with pytest.raises(lapwing.InputError, match=r"wrap: landmarks\[0\]: the template has no vertex"):
        lapwing.wrap(template, placed, [[10**6, 0, 0, 0]], scan_faces=scan.faces)


def test_a_symmetric_template_stays_symmetric_and_detail_ends_on_the_scan():
    V = np.array(lapwing.shape("sphere").vertices)
    faces = lapwing.shape("sphere").faces
    scan = np.where(V[:, :1] > 0.0, V * [0.8, 1.0, 1.0], V * [1.2, 1.0, 1.0])
    plane = {"plane": "x"}
    keys = dict(faces=faces, scan_faces=faces, aligned=True)
    symmetric = lapwing.wrap(V, scan, mirror=plane, **keys).mesh.vertices
    images = [np.abs(V - v * [-1, 1, 1]).sum(axis=1).argmin() for v in V]
    assert np.abs(symmetric[images] * [-1, 1, 1] - symmetric).max() < 1e-9
    with pytest.raises(lapwing.InputError, match="wrap: mirror: vertex .* has no mirror image"):
        lapwing.wrap(scan, V, mirror=plane, **keys)
    landmark = {0: 1.3 * V[0]}
    exact = lapwing.wrap(V, scan, landmark, hard=True, detail=True, **keys)
    assert exact.landmark_error < 1e-6 and exact.to_scan.percentile_95 < 1e-9


def test_poses_are_transferred_to_another_mesh():
    source = lapwing.shape("tube")
    V = np.array(source.vertices)
    target = lapwing.subdivide(source).mesh
    rest = np.array(target.vertices)

    def pose(points, factor):
        return points * [1.0 + factor * 0.1, 1.0, 1.0 - factor * 0.05] + [factor, 0.0, 0.0]

    many = np.array([pose(V, factor) for factor in (0.0, 1.0, 2.0)])
    moved = lapwing.transfer(source, many, target, correspondence=rest)
    assert moved.vertices.shape == (3, len(rest), 3) and not moved.warnings
    for factor, vertices in enumerate(moved.vertices):
        assert np.abs(vertices - pose(rest, factor)).max() < 1e-2
    one = lapwing.transfer(source, many[2], target, correspondence=rest)
    assert np.array_equal(one.vertices, moved.vertices[2])
    same = lapwing.transfer(V, [many[1]], V, faces=source.faces, target_faces=source.faces)
    assert np.abs(same.vertices[0] - many[1]).max() < 1e-6
    held = lapwing.transfer(source, many[1], source, held=[0, 1, 2, 3])
    assert np.abs(held.vertices[:4] - V[:4]).max() < 1e-3
    with pytest.raises(lapwing.InputError, match="vertices: expected"):
        lapwing.transfer(source, many[:, :-1], target, correspondence=rest)
    many[1, 5] = np.nan
    with pytest.raises(lapwing.InputError, match=r"poses\[1\]: vertex 5 is not finite"):
        lapwing.transfer(source, many, target, correspondence=rest)


def test_landmarks_of_a_wrap_are_vertices_or_files(tmp_path):
    template = lapwing.decimate(lapwing.shape("sphere"), share=0.05).mesh
    V = np.array(template.vertices)
    scan = template.with_vertices(V * [1.0, 1.2, 1.5])
    corners = [int(np.argmax(V @ axis)) for axis in ([1, 0, 0], [0, 1, 0], [0, 0, 1])]
    by_vertices = lapwing.wrap(template, scan, {c: c for c in corners})
    assert by_vertices.landmark_error < 0.01 and not by_vertices.notes
    rows = tmp_path / "rows.json"
    rows.write_text(json.dumps([{"vertex": c, "scan_vertex": c} for c in corners]))
    by_file = lapwing.wrap(template, scan, rows)
    assert (by_file.mesh.vertices == by_vertices.mesh.vertices).all()
    for name, places in (("template", V), ("scan", scan.vertices)):
        lines = [f"{c},{','.join(map(repr, places[c].tolist()))}" for c in corners]
        extra = ["ear,1,0,0"] if name == "template" else []
        (tmp_path / f"{name}.csv").write_text("\n".join(["label,x,y,z", *lines, *extra]))
    by_points = lapwing.wrap(template, scan, (tmp_path / "template.csv", tmp_path / "scan.csv"))
    assert (by_points.mesh.vertices == by_vertices.mesh.vertices).all()
    assert "ear" in by_points.notes[0]
    step = {"op": "wrap", "scan": "scan", "landmarks": {c: c for c in corners}}
    ran = lapwing.run({"lapwing": 1, "mesh": "template", "steps": [step]},
                      {"template": template, "scan": scan})
    assert (ran.vertices == by_vertices.mesh.vertices).all()


def test_check_and_fix():
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0], [5, 5, 5]]
    found = lapwing.check(corners, [[0, 1, 2], [3, 4, 5]])
    kinds = {defect.kind: defect for defect in found.defects}
    assert found.has_problems and kinds["loose_vertex"].first.tolist() == [6]
    assert kinds["unwelded_seam"].severity == "warning"
    fixed = lapwing.fix(corners, [[0, 1, 2], [3, 4, 5]])
    assert fixed.repairs["removed_loose_vertices"] == 1 and fixed.mesh.vertex_count == 4
    assert fixed.vertex_sources.tolist() == [0, 1, 2, 5]


def test_fill_holes():
    tube = lapwing.shape("tube")
    found = lapwing.check(tube)
    assert len(found.holes) == 2 and not found.holes[0].is_border and found.holes[0].rim[0] == 0
    flat = lapwing.fill_holes(tube, shape="flat")
    assert flat.holes == 2 and flat.new_vertices == 0
    assert lapwing.check(flat.mesh).statistics["boundary_loops"] == 0
    smooth = lapwing.fill_holes(tube.vertices, tube.faces)
    assert smooth.new_vertices > 0 and smooth.mesh.vertex_count == tube.vertex_count + smooth.new_vertices
    assert lapwing.fill_holes(tube, largest=3).holes == 0
    sheet = lapwing.shape("sheet")
    assert lapwing.fill_holes(sheet).holes == 0 and lapwing.fill_holes(sheet, borders=True).holes == 1
    with pytest.raises(lapwing.InputError, match="fill_holes: shape"):
        lapwing.fill_holes(tube, shape="round")


def test_decimate_and_subdivide():
    ball = lapwing.shape("sphere")
    coarse = lapwing.decimate(ball, share=0.25)
    assert abs(coarse.mesh.vertex_count / ball.vertex_count - 0.25) < 0.1
    assert (coarse.vertices == ball.vertices[coarse.kept]).all()
    fine = lapwing.subdivide(ball, times=2)
    assert fine.mesh.face_count == 16 * ball.face_count
    assert (fine.vertices[:ball.vertex_count] == ball.vertices).all()
    smooth = lapwing.subdivide(ball.vertices, ball.faces, smooth=True)
    assert (smooth.vertices[:ball.vertex_count] != ball.vertices).any()


def test_generated_meshes_are_listed():
    assert "tube" in lapwing.shape_names()
    assert all(lapwing.shape(name).face_count > 0 for name in lapwing.shape_names())


def recipe_of(tube, ends):
    return {
        "lapwing": 1,
        "mesh": "tube",
        "steps": [
            {"op": "deform", "roi": "all", "belt": ends[0], "handles": [(ends[1], turned(25.0))]}
        ],
    }


def test_a_recipe_runs_on_meshes_in_memory(tube, ends):
    result = lapwing.run(recipe_of(tube, ends), {"tube": tube})
    same = lapwing.deform(tube, belt=ends[0], handles=[(ends[1], turned(25.0))])
    assert (result.vertices == same.vertices).all()
    assert json.loads(result.report_json)["steps"][0]["op"] == "deform"


def test_a_recipe_runs_from_its_file_and_saves_when_asked(tube, ends, tmp_path):
    lapwing.write(tmp_path / "tube.off", tube)
    recipe = recipe_of(tube, ends)
    step = recipe["steps"][0]
    step["roi"] = {"all": True}
    step["belt"] = {"vertices": ends[0].tolist()}
    step["handles"] = [
        {"region": {"vertices": ends[1].tolist()}, "move": {"matrix": turned(25.0).ravel().tolist()}}
    ]
    (tmp_path / "bend.json").write_text(json.dumps({**recipe, "mesh": "tube.off", "save": "bent.off"}))
    result = lapwing.run(tmp_path / "bend.json")
    assert not (tmp_path / "bent.off").exists()
    lapwing.run(tmp_path / "bend.json", save=True)
    assert (lapwing.read(tmp_path / "bent.off").vertices == result.vertices).all()


def test_recipes_that_cannot_be_name_the_place(tube, ends, tmp_path):
    recipe = recipe_of(tube, ends)
    with pytest.raises(lapwing.InputError, match="unsupported mesh format"):
        lapwing.run(recipe)
    with pytest.raises(lapwing.FileError, match="tube.obj"):
        lapwing.run({**recipe, "mesh": "tube.obj"})
    recipe["steps"][0]["roy"] = "all"
    with pytest.raises(lapwing.InputError, match="recipe: /steps/0/roy: unknown key"):
        lapwing.run(recipe, {"tube": tube})
    with pytest.raises(lapwing.FileError, match="nowhere.json"):
        lapwing.run(tmp_path / "nowhere.json")


def test_pictures_are_arrays_and_files(tube, tmp_path):
    picture = lapwing.render(tube, size=(160, 120), up="z")
    assert picture.shape == (120, 160, 4) and picture.dtype == np.uint8
    assert (picture[0, 0] == 255).all() and (picture != 255).any()
    colored = lapwing.render(tube, values=tube.vertices[:, 2], legend="height", size=(160, 120))
    assert (colored != picture).any()
    lapwing.render(tube, size=(160, 120), up="z", path=tmp_path / "tube.png")
    assert (tmp_path / "tube.png").read_bytes().startswith(b"\x89PNG\r\n")
    with pytest.raises(lapwing.InputError, match="ends in .png"):
        lapwing.render(tube, path=tmp_path / "tube.jpg")
    for wrong in (dict(values=[1.0]), dict(view="inside"), dict(up="x"), dict(from_=[0, 1, 0])):
        with pytest.raises(lapwing.InputError):
            lapwing.render(tube, **wrong)
    with pytest.raises(lapwing.DeviceError):
        lapwing.render(tube, device="no such device")


def test_names_that_are_not_utf8(tmp_path):
    lapwing.write(tmp_path / "plain.obj", lapwing.shape("sphere"))
    name = os.fsencode(tmp_path) + b"/m\xf6we.obj"
    with open(name, "wb") as file:
        file.write(b"mtllib m\xf6we.mtl\n" + (tmp_path / "plain.obj").read_bytes())
    for path in (name, os.fsdecode(name)):
        mesh = lapwing.read(path)
        assert "m\\xF6we.mtl" in lapwing.write(tmp_path / "out.obj", mesh)[0]
    assert lapwing.write(os.fsdecode(name), mesh)
    with pytest.raises(lapwing.FileError, match=r"none-\\xF6"):
        lapwing.read(os.fsencode(tmp_path) + b"/none-\xf6.obj")
