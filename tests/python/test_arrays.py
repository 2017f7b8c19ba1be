"""What is accepted as a mesh, and how what is not is refused."""

from types import SimpleNamespace

import numpy as np
import pytest

import lapwing

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
TWO = np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize("kind", [np.int8, np.uint16, np.int32, np.uint32, np.int64, np.uint64])
@pytest.mark.parametrize("order", ["C", "F"])
def test_faces_of_any_whole_type_and_order(kind, order):
    mesh = lapwing.Mesh(SQUARE, np.array(TWO, dtype=kind, order=order))
    assert (mesh.faces == TWO).all()


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64, np.int32, np.longdouble, ">f8"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_vertices_of_any_real_type_and_order(kind, order):
    mesh = lapwing.Mesh(np.array(SQUARE, dtype=kind, order=order), TWO)
    assert mesh.vertices.dtype == np.float64
    assert (mesh.vertices == SQUARE).all()


def test_slices_and_reversed_arrays():
    wide = np.repeat(SQUARE, 2, axis=0)
    mesh = lapwing.Mesh(wide[::2], TWO[::-1])
    assert (mesh.vertices == SQUARE).all()
    assert (mesh.faces == TWO[::-1]).all()


def test_lists_quads_and_polygons():
    assert (lapwing.Mesh(SQUARE.tolist(), TWO.tolist()).faces == TWO).all()
    assert lapwing.Mesh(SQUARE, [[0, 1, 2, 3]]).faces.shape == (1, 4)
    mixed = lapwing.Mesh(SQUARE, [[0, 1, 2, 3], [0, 1, 2]]).faces
    assert [face.tolist() for face in mixed] == [[0, 1, 2, 3], [0, 1, 2]]


def test_a_mesh_is_two_arrays():
    vertices, faces = lapwing.Mesh(SQUARE, TWO)
    assert (vertices == SQUARE).all() and (faces == TWO).all()


def test_objects_of_other_libraries_by_their_attributes():
    trimesh = SimpleNamespace(vertices=SQUARE, faces=TWO)
    open3d = SimpleNamespace(vertices=SQUARE.tolist(), triangles=TWO)
    tensor = SimpleNamespace(
        vertex={"positions": SimpleNamespace(numpy=lambda: SQUARE.astype(np.float32))},
        triangle={"indices": SimpleNamespace(numpy=lambda: TWO)},
    )
    for mesh in (trimesh, open3d, tensor, (SQUARE, TWO)):
        assert lapwing.check(mesh).statistics["faces"] == 2


def test_a_mesh_does_not_change_with_its_arrays():
    vertices = SQUARE.copy()
    mesh = lapwing.Mesh(vertices, TWO)
    vertices[:] = 7.0
    assert (mesh.vertices == SQUARE).all()
    V, F = mesh
    V[:] = 7.0
    F[:] = 0
    assert (mesh.vertices == SQUARE).all() and (mesh.faces == TWO).all()


def test_arrays_that_would_lose_what_is_written_to_them_are_read_only():
    mesh = lapwing.Mesh(SQUARE, TWO)
    mixed = lapwing.Mesh(SQUARE, [[0, 1, 2, 3], [0, 1, 2]])
    result = lapwing.deform(mesh, belt=[0], handles=[([2], turned_by_nothing())])
    edit = lapwing.Deformer(mesh, belt=[0], handles=[[2]])
    arrays = [
        mesh.vertices, mesh.faces, mixed.faces[0], result.vertices, result.faces, result.rotations,
        result.displacements, result.roi, result.belt, result.handles[0], edit.roi, edit.belt,
        edit.handles[0], lapwing.peel(mesh, detail_size=0.1).vertices,
        result.certificate.first_flipped_triangles,
    ]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[:1] = 0


def mask_of(chosen, kind):
    mask = np.zeros(9, kind)
    mask[chosen] = 1
    return mask


#: A square of 3 x 3 vertices.
GRID = [[x, y, 0.1 * x * y] for y in range(3) for x in range(3)]
GRID_FACES = [[v, v + 1, v + 4, v + 3] for v in (0, 1, 3, 4)]


@pytest.mark.parametrize("kind", [bool, int, np.uint8, np.int32, np.uint64])
@pytest.mark.parametrize("wrap", [lambda mask: mask, list, lambda mask: {"vertices": mask},
                                  lambda mask: {"union": [mask, [4]]}])
def test_a_mask_of_any_type_is_a_mask(kind, wrap):
    move = {"translate": [0.0, 0.0, 0.1]}
    mask = mask_of([4, 8], kind)
    listed = lapwing.deform(GRID, GRID_FACES, belt=[0, 1, 2], handles=[([4, 8], move)])
    masked = lapwing.deform(GRID, GRID_FACES, belt=mask_of([0, 1, 2], kind), handles=[(wrap(mask), move)])
    assert masked.handles[0].tolist() == [4, 8] and masked.belt.tolist() == [0, 1, 2]
    assert (masked.vertices == listed.vertices).all()


def test_an_empty_mask_is_an_empty_region():
    move = {"translate": [0.0, 0.0, 0.1]}
    with pytest.raises(lapwing.InputError, match="no vertices|empty|has no vert"):
        lapwing.deform(GRID, GRID_FACES, handles=[(mask_of([], int), move)])


@pytest.mark.parametrize(
    "vertices, message",
    [
        ([4, 8, 4], "vertex 4 is listed 2 times"),
        (np.array([0, 1, 0, 1, 1]), "vertex 0 is listed 2 times"),
        (np.array([2, 0, 1, 2, 2, 0, 1, 2, 2]), "A mask has the type bool"),
        (mask_of([4], float), "a mask has the type bool"),
        ({"vertices": [1, 1]}, "vertex 1 is listed 2 times"),
    ],
)
def test_labels_and_repeated_vertices_are_refused(vertices, message):
    with pytest.raises(lapwing.InputError) as raised:
        lapwing.deform(GRID, GRID_FACES, handles=[(vertices, turned_by_nothing())])
    assert message in str(raised.value) and "handles[0].region" in str(raised.value)


def test_sets_and_ranges_are_vertex_numbers():
    for chosen in ({4, 8}, frozenset([8, 4]), range(4, 9, 4)):
        edit = lapwing.Deformer(GRID, GRID_FACES, belt=[0], handles=[chosen])
        assert edit.handles[0].tolist() == [4, 8]


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.float16, float])
def test_scalars_of_numpy_are_numbers(kind):
    handles = [([8], {"translate": [kind(0), kind(0), kind(0.5)], "scale": kind(1)})]
    by_kind = lapwing.deform(GRID, GRID_FACES, belt=kind(0.25), detail_length=kind(0.5), handles=handles)
    by_float = lapwing.deform(
        GRID, GRID_FACES, belt=0.25, detail_length=0.5,
        handles=[([8], {"translate": [0, 0, 0.5], "scale": 1})],
    )
    assert (by_kind.vertices == by_float.vertices).all()
    assert lapwing.peel(GRID, GRID_FACES, detail_size=kind(0.5)).moved.size > 0
    finer = lapwing.remesh(GRID, GRID_FACES, length=kind(0.5), iterations=np.int64(2))
    assert finer.mesh.vertex_count > 9


def _transposed(corners):
    """A square of 6 x 6 vertices with triangles or quads, and its faces as columns."""
    vertices = [[x, y, 0] for y in range(6) for x in range(6)]
    starts = [6 * y + x for y in range(5) for x in range(5)]
    quads = [[v, v + 1, v + 7, v + 6] for v in starts]
    triangles = [[a, b, c] for q in quads for a, b, c in (q[:3], [q[0], q[2], q[3]])]
    return vertices, np.transpose(quads if corners == 4 else triangles)


BAD = {
    "vertices: expected shape (n, 3), got (4, 2)": lambda: lapwing.Mesh(SQUARE[:, :2], TWO),
    "vertices: expected shape (n, 3), got (3,)": lambda: lapwing.Mesh([1.0, 2.0, 3.0], TWO),
    "got (1, 1, 1, 4, 3)": lambda: lapwing.Mesh(SQUARE[None, None, None], TWO),
    "vertices: expected real numbers, got an array of type complex128": lambda: lapwing.Mesh(
        SQUARE + 1j, TWO
    ),
    "vertices: expected real numbers, got an array of type bool": lambda: lapwing.Mesh(
        SQUARE > 0, TWO
    ),
    "vertices: expected real numbers, got an array of type object": lambda: lapwing.Mesh(
        [[None, 1, 2]], TWO
    ),
    "faces: expected whole numbers, got an array of type float64": lambda: lapwing.Mesh(
        SQUARE, TWO.astype(float)
    ),
    "faces: expected shape (m, 3)": lambda: lapwing.Mesh(SQUARE, TWO[:, :2]),
    "faces: expected shape (m, 3), (m, 4) or more corners, or a list": lambda: lapwing.Mesh(
        SQUARE, TWO[None, None, None]
    ),
    "faces: 3 faces of 50 corners have too many for the 36 vertices. A row must be a face": (
        lambda: lapwing.deform(*_transposed(3))
    ),
    "faces: 4 faces of 25 corners have too many for the 36 vertices": (
        lambda: lapwing.deform(*_transposed(4))
    ),
    "faces[1]: expected at least 3 whole numbers, got [0, 1]": lambda: lapwing.Mesh(
        SQUARE, [[0, 1, 2], [0, 1]]
    ),
    "faces[0]: expected at least 3 whole numbers": lambda: lapwing.Mesh(SQUARE, [[0.0, 1.0, 2.0]]),
    "faces[1] names vertex 4, but there are 4 vertices": lambda: lapwing.Mesh(
        SQUARE, [[0, 1, 2], [0, 2, 4]]
    ),
    "faces[0] names vertex -1": lambda: lapwing.Mesh(SQUARE, [[0, 1, -1]]),
    "faces[0] names vertex": lambda: lapwing.Mesh(SQUARE, np.array([[0, 1, 2**63]], np.uint64)),
    "expected vertices and faces, or an object with both": lambda: lapwing.check(None),
    "roi: expected vertex numbers, got an array of type float64": lambda: lapwing.deform(
        SQUARE, TWO, roi=[0.5]
    ),
    "roi: expected a mask with a value for each of the 4 vertices, got 3": lambda: lapwing.deform(
        SQUARE, TWO, roi=np.ones(3, bool)
    ),
    "roi[1]: expected a vertex number from 0, got -2": lambda: lapwing.deform(
        SQUARE, TWO, roi=[0, -2]
    ),
    'roi: expected "all", vertex numbers, a mask or a region, got "most"': lambda: lapwing.deform(
        SQUARE, TWO, roi="most"
    ),
    "unknown key; did you mean \"disk\"?": lambda: lapwing.deform(SQUARE, TWO, roi={"disc": 1}),
    "nothing is moved": lambda: lapwing.deform(SQUARE, TWO),
    "handles[0]: expected a pair (region, move)": lambda: lapwing.deform(SQUARE, TWO, handles=[3]),
    "handles[0].move: expected a matrix of shape (4, 4)": lambda: lapwing.deform(
        SQUARE, TWO, handles=[([0], np.eye(3))]
    ),
    "handles[0].move[1, 2]: the number is not finite": lambda: lapwing.deform(
        SQUARE, TWO, handles=[([0], np.where(np.arange(16).reshape(4, 4) == 6, np.nan, 0.0))]
    ),
    "expected the last row 0 0 0 1": lambda: lapwing.deform(
        SQUARE, TWO, handles=[([0], np.ones((4, 4)))]
    ),
    "detail_length: expected a number from 0.000001 to 1000": lambda: lapwing.deform(
        SQUARE, TWO, detail_length=-1, handles=[([0], np.eye(4))]
    ),
    'weights: expected one of "uniform", "cotangent", got "equal"': lambda: lapwing.peel(
        SQUARE, TWO, detail_size=0.1, weights="equal"
    ),
    'domain: expected one of "disk", "square", got "round"': lambda: lapwing.parameterize(
        SQUARE, TWO, domain="round"
    ),
    "pins[1]: expected a vertex number from 0, got -1": lambda: lapwing.parameterize(
        SQUARE, TWO, pins=[0, -1]
    ),
    "pins: expected vertex numbers, got an array of type float64": lambda: lapwing.parameterize(
        SQUARE, TWO, pins=[0.5]
    ),
    "deform: landmarks[0]: vertex 1 is listed 2 times": lambda: lapwing.deform(
        SQUARE, TWO, landmarks=([1, 1], SQUARE[:2])
    ),
    "deform: landmarks[1]: expected positions of shape (2, 3)": lambda: lapwing.deform(
        SQUARE, TWO, landmarks=([0, 1], SQUARE)
    ),
    "deform: landmarks: expected a pair": lambda: lapwing.deform(SQUARE, TWO, landmarks=[1, 2, 3]),
    "deform: give landmarks or targets": lambda: lapwing.deform(
        SQUARE, TWO, landmarks=([0], SQUARE[:1]), targets={0: [0, 0, 0]}
    ),
    "targets[0, 1]: the number is not finite": lambda: lapwing.deform(
        SQUARE, TWO, targets=np.array([[0, np.inf, 0, 0]])
    ),
}


@pytest.mark.parametrize("message", BAD)
def test_bad_input_names_its_place(message):
    with pytest.raises(lapwing.InputError) as raised:
        BAD[message]()
    assert message in str(raised.value)
    assert isinstance(raised.value, ValueError)


def test_errors_carry_the_vertices_they_are_about():
    broken = SQUARE.copy()
    broken[3, 1] = np.nan
    with pytest.raises(lapwing.InputError) as raised:
        lapwing.deform(broken, TWO, handles=[([0], turned_by_nothing())])
    assert raised.value.vertices.tolist() == [3]
    with pytest.raises(lapwing.InputError) as raised:
        lapwing.Mesh(SQUARE, [[0, 1, 9]])
    assert raised.value.vertices.tolist() == [9]
    with pytest.raises(lapwing.InputError) as raised:
        lapwing.deform(SQUARE, TWO, roi=[0, 1, 2], handles=[([1, 3], turned_by_nothing())])
    assert raised.value.vertices.tolist() == [3]


def turned_by_nothing():
    return {"translate": [0, 0, 0]}


def test_empty_arrays_are_a_mesh_without_an_edit():
    empty = lapwing.Mesh(np.zeros((0, 3)), [])
    assert empty.vertices.shape == (0, 3) and empty.faces.shape == (0, 3)
    assert [d.kind for d in lapwing.check(empty).defects] == ["no_faces"]
    with pytest.raises(lapwing.InputError):
        lapwing.deform(empty, handles=[([], turned_by_nothing())])


def test_files_that_cannot_be_read_are_os_errors(tmp_path):
    with pytest.raises(lapwing.FileError) as raised:
        lapwing.read(tmp_path / "nowhere.obj")
    assert isinstance(raised.value, OSError)
    (tmp_path / "broken.obj").write_text("v 0 0 0\nv 1 x 0\n")
    with pytest.raises(lapwing.InputError, match="broken.obj:2"):
        lapwing.read(tmp_path / "broken.obj")
