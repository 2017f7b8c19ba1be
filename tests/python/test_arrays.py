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


def test_arrays_are_copies():
    vertices = SQUARE.copy()
    mesh = lapwing.Mesh(vertices, TWO)
    vertices[:] = 7.0
    assert (mesh.vertices == SQUARE).all()
    mesh.vertices[:] = 7.0
    assert (mesh.vertices == SQUARE).all()


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
