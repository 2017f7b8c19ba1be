"""An edit that is prepared once."""

import pickle
import threading

import numpy as np
import pytest

import lapwing
from conftest import turned


@pytest.fixture(scope="module")
def bend(tube, ends):
    return lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]])


def motions_of(count: int) -> np.ndarray:
    return np.array([[turned(7.0 * k, [0.02 * k, 0.0, 0.0])] for k in range(count)])


def test_solve_is_deform(tube, ends, bend):
    for motion in motions_of(4):
        once = lapwing.deform(tube, belt=ends[0], handles=[(ends[1], motion[0])])
        again = bend.solve(motion)
        assert (once.vertices == again.vertices).all()
        assert (once.rotations == again.rotations).all()


def test_a_free_handle_goes_to_its_place_and_turns(tube, ends, bend):
    aside = turned(0.0, [0.4 * np.ptp(tube.vertices[:, 2]), 0.0, 0.0])
    kept = bend.solve(aside)
    free = bend.solve(aside, free=[True])
    handle = bend.handles[0]
    place = (tube.vertices[handle] @ aside[:3, :3].T + aside[:3, 3]).mean(axis=0)
    assert np.abs(free.vertices[handle].mean(axis=0) - place).max() < 0.02 * np.ptp(tube.vertices)
    assert free.certificate.edge_stretch < kept.certificate.edge_stretch
    by_key = lapwing.deform(
        tube, belt=ends[0],
        handles=[{"region": ends[1], "move": {"matrix": aside.ravel()}, "orientation": "free"}],
    )
    assert (by_key.vertices == free.vertices).all()


def test_a_mirrored_edit_is_prepared_too():
    grid = lapwing.shape("sheet")
    x, y, z = grid.vertices.T
    hand = np.hypot(x - np.quantile(x, 0.75), y - np.median(y)) < 0.1 * np.ptp(x)
    lift = np.eye(4)
    lift[2, 3] = 0.1 * np.ptp(x)
    mirror = {"point": [np.mean(x), 0.0, 0.0], "normal": [1.0, 0.0, 0.0]}
    edit = lapwing.Deformer(grid, handles=[hand], mirror=mirror)
    once = lapwing.deform(grid, handles=[(hand, lift)], mirror=mirror)
    assert (edit.solve(lift).vertices == once.vertices).all()


def test_one_result_does_not_depend_on_those_before(bend):
    motions = motions_of(6)
    forward = [bend.solve(motion).vertices for motion in motions]
    backward = [bend.solve(motion).vertices for motion in motions[::-1]][::-1]
    for one, other in zip(forward, backward):
        assert (one == other).all()


@pytest.mark.parametrize("threads", [None, 1, 2, 3])
def test_solve_many_is_solve_on_any_number_of_threads(bend, threads):
    motions = motions_of(7)
    many = bend.solve_many(motions, threads=threads)
    assert many.vertices.shape == (7, bend.mesh.vertex_count, 3)
    for k, motion in enumerate(motions):
        assert (many.vertices[k] == bend.solve(motion).vertices).all()
        assert many.certificates[k].settled


def test_solve_many_in_single_precision_is_rounded(bend):
    motions = motions_of(3)
    exact = bend.solve_many(motions).vertices
    rounded = bend.solve_many(motions, dtype=np.float32).vertices
    assert rounded.dtype == np.float32 and (rounded == exact.astype(np.float32)).all()


def test_no_motions_are_no_results(bend):
    assert bend.solve_many(np.zeros((0, 1, 4, 4))).vertices.shape == (0, bend.mesh.vertex_count, 3)


def test_rows_of_three_are_matrices_too(bend):
    motion = motions_of(2)[1]
    assert (bend.solve(motion[:, :3]).vertices == bend.solve(motion).vertices).all()
    assert (bend.solve(motion[0]).vertices == bend.solve(motion).vertices).all()


def test_threads_take_turns_on_one_deformer(bend):
    motions = motions_of(8)
    alone = [bend.solve(motion).vertices for motion in motions]
    together = [None] * 8

    def solve(k):
        together[k] = bend.solve(motions[k]).vertices

    threads = [threading.Thread(target=solve, args=(k,)) for k in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, other in zip(alone, together):
        assert (one == other).all()


def test_a_pickled_one_is_prepared_anew_and_the_same(bend):
    copy = pickle.loads(pickle.dumps(bend))
    motion = motions_of(3)[2]
    assert (copy.solve(motion).vertices == bend.solve(motion).vertices).all()
    assert (copy.belt == bend.belt).all() and repr(copy) == repr(bend)


@pytest.mark.parametrize(
    "motions, message",
    [
        (np.eye(4), "motions: expected shape (count, 1, 4, 4), a matrix for each handle, got (4, 4)"),
        (np.zeros((2, 2, 4, 4)), "got (2, 2, 4, 4)"),
        (np.zeros((2, 1, 4, 4)), "motions[0, 0]: expected the last row 0 0 0 1"),
        (np.full((2, 1, 4, 4), np.nan), "motions[0, 0]: a number is not finite"),
        (np.full((1, 1, 4, 4), "a"), "motions: expected real numbers"),
    ],
)
def test_motions_that_are_none_are_named(bend, motions, message):
    with pytest.raises(lapwing.InputError) as raised:
        bend.solve_many(motions)
    assert message in str(raised.value)


def test_what_is_wrong_with_an_edit_is_said_when_it_is_prepared(tube, ends):
    with pytest.raises(lapwing.InputError, match="shares"):
        lapwing.Deformer(tube, belt=ends[0], handles=[ends[0]])
    with pytest.raises(lapwing.InputError, match="dtype"):
        lapwing.Deformer(tube, belt=ends[0], handles=[ends[1]]).solve_many(
            motions_of(1), dtype=np.int32
        )


def test_a_response_adds_up_to_a_solve_without_settling(tube, ends):
    middle = np.flatnonzero(np.abs(tube.vertices[:, 2] - tube.vertices[:, 2].mean()) < 0.05)[:2]
    handles = [ends[1], middle]
    bend = lapwing.Deformer(tube, belt=ends[0], handles=handles)
    straight = lapwing.Deformer(tube, belt=ends[0], handles=handles, settle=False)
    motions = np.array([turned(40.0, [0.1, 0.0, 0.2]), turned(-10.0, [0.0, 0.1, 0.0])])
    both = bend.response()
    assert both.columns.shape == (2, 3, 4, tube.vertex_count, 3) and both.centers.shape == (2, 3)
    np.testing.assert_allclose(both.centers[0], tube.vertices[ends[1]].mean(axis=0), atol=1e-12)
    tolerance = 1e-6 * np.linalg.norm(np.ptp(tube.vertices, axis=0))
    for surface in (both.displacements(motions), both.displacements(motions[:, :3])):
        expected = straight.solve(motions).vertices
        assert np.abs(tube.vertices + surface - expected).max() < tolerance

    one = bend.response([1])
    expected = straight.solve([np.eye(4), motions[1]]).vertices
    assert np.abs(tube.vertices + one.displacements(motions[1:]) - expected).max() < tolerance
    assert not one.displacements([np.eye(4)]).any()
    assert bend.response([]).columns.shape == (0, 3, 4, tube.vertex_count, 3)


def test_a_response_to_what_is_no_handle_is_refused(bend):
    for handles in ([1], [-1]):
        with pytest.raises(lapwing.InputError, match="numbered from 0|numbers from 0"):
            bend.response(handles)
    with pytest.raises(lapwing.InputError, match=r"expected shape \(1, 4, 4\)"):
        bend.response().displacements(np.eye(4))
