"""An edit that is prepared once and solved for many motions."""

from __future__ import annotations

import operator
from typing import Any, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arguments import Array, mesh_of
from ._operations import Progress, deform_step


class Many(NamedTuple):
    """What `Deformer.solve_many` returns."""

    #: (k, n, 3), float64 or float32 as asked.
    vertices: Array
    #: One for each motion.
    certificates: List[_core.Certificate]


class Response(NamedTuple):
    """How the surface follows handles to first order, as `Deformer.response` returns it."""

    #: (k, 3, 4, n, 3): the displacement of every vertex where entry (a, b) of a handle's motion, seen
    #: from its centre, is one more than at rest. [:, :, :3] are lengths of the mesh, [:, :, 3] are
    #: displacements per length and have no unit.
    columns: Array
    #: (k, 3), in the mesh's coordinates: the centroid of each handle's vertices.
    centers: Array
    #: Why details do not turn: what the exact system would need, and may take. Empty where they do.
    why_not_exact: str = ""

    def displacements(self, motions: Any) -> Array:
        """(n, 3), what is to be added to the vertices at rest, for one motion for each of the k
        handles: matrices of shape (k, 4, 4) or (k, 3, 4), as those of `Deformer.solve`."""
        given = np.asarray(motions, np.float64)
        count = len(self.centers)
        if given.ndim != 3 or given.shape[0] != count or given.shape[1:] not in ((3, 4), (4, 4)):
            raise _core.InputError(
                f"motions: expected shape ({count}, 4, 4), a matrix for each handle, got {given.shape}"
            )
        linear = given[:, :3, :3] - np.eye(3)
        way = np.einsum("kab,kb->ka", linear, self.centers) + given[:, :3, 3]
        return np.tensordot(np.dstack([linear, way]), self.columns, axes=3)


class Deformer:
    """A region and its handles, prepared once, for as many motions as wanted.

        d = lapwing.Deformer(V, F, roi=roi, belt=0.1, handles=[hand])
        raised = d.solve([matrix])              # one motion per handle
        many = d.solve_many(matrices)           # shape (k, handles, 4, 4), on all threads

    `handles` are regions (or dicts with "region" and how firmly it holds: "weight", "falloff");
    everything else is as in `lapwing.deform`, and so are the results, bit for bit. Preparing takes
    tens of milliseconds for ten thousand vertices and about 8 kB of memory a vertex. Threads may
    share one: their calls take turns. It can be pickled; whoever unpickles it prepares anew, so
    that a cluster's workers get one each.
    """

    def __init__(
        self,
        mesh: Any,
        faces: Any = None,
        roi: Any = "all",
        belt: Any = None,
        handles: Sequence[Any] = (),
        *,
        targets: Any = None,
        mirror: Any = None,
        hard: Optional[bool] = None,
        detail_length: Optional[float] = None,
        constraint_weight: Optional[float] = None,
        settle: Any = None,
        weights: Optional[str] = None,
        response: Optional[str] = None,
        loose: Optional[str] = None,
        seams: Optional[str] = None,
        progress: Progress = None,
    ) -> None:
        chosen = mesh_of(mesh, faces, "Deformer: mesh")
        keys = dict(
            roi=roi, belt=belt, targets=targets, mirror=mirror, hard=hard,
            detail_length=detail_length, constraint_weight=constraint_weight, settle=settle,
            weights=weights, response=response, loose=loose, seams=seams,
            handles=[_at_rest(handle) for handle in handles],
        )
        step = deform_step(chosen.vertex_count, "Deformer", keys)
        self._prepare(chosen, step, progress)

    def _prepare(self, mesh: _core.Mesh, step: str, progress: Progress) -> None:
        self._step = step
        self._edit = _core.Edit(mesh, step, progress)

    @property
    def mesh(self) -> _core.Mesh:
        """The mesh at rest."""
        return self._edit.mesh

    @property
    def roi(self) -> Array:
        """The vertices that may move, ascending."""
        return self._edit.roi

    @property
    def belt(self) -> Array:
        """Those of them that stay."""
        return self._edit.belt

    @property
    def handles(self) -> List[Array]:
        """The vertices of each handle."""
        return self._edit.handles

    def solve(
        self, motions: Any, *, free: Optional[Sequence[bool]] = None, progress: Progress = None
    ) -> _core.Result:
        """The settled surface for one motion per handle: matrices of shape (handles, 4, 4) or
        (handles, 3, 4) that act on column vectors at rest. With one handle a single matrix will
        do. `free` says for each handle whether its orientation is free; by default that is what the
        handles say."""
        matrices = np.asarray(motions)
        if matrices.ndim == 2 and self._edit.handle_count == 1:
            matrices = matrices[np.newaxis]
        return self._edit.solve(matrices[np.newaxis], free, progress)

    def solve_many(
        self,
        motions: Any,
        *,
        threads: Optional[int] = None,
        dtype: Any = np.float64,
        progress: Progress = None,
    ) -> Many:
        """The settled surfaces for `motions` of shape (k, handles, 4, 4): `vertices` of shape
        (k, n, 3), of type `dtype`, float64 or float32, and a certificate each.

        Runs on `threads` threads, by default all; each but the first prepares for itself, with
        memory of its own. The bits do not depend on how many there are.
        """
        count = 0 if threads is None else int(threads)
        if count < 0:
            raise _core.InputError(f"threads: expected a number above 0, got {count}")
        kind = np.dtype(dtype)
        if kind == np.float32:
            return Many(*self._edit.solve_many_float32(motions, count, progress))
        if kind == np.float64:
            return Many(*self._edit.solve_many(motions, count, progress))
        raise _core.InputError(f"dtype: expected float64 or float32, got {kind}")

    def response(
        self, handles: Optional[Sequence[int]] = None, *, progress: Progress = None
    ) -> Response:
        """How the surface follows `handles`, by default all, linearly: 12 columns each, to be added
        up for every frame of a drag, in microseconds a thousand vertices.

            linear = d.response()
            shown = V + linear.displacements([matrix])

        `handles` are numbers from 0. The columns come from what is prepared, by 12 right-hand sides
        a handle, and take 288 bytes a vertex and handle. What a Deformer with `settle=False` solves
        is V + `displacements` to 1e-6 of the diagonal, but for loose parts, which turn here to first
        order alone; targets are left out, and images of mirrored handles go along. A region that is
        too large for the exact system (`why_not_exact` says so) follows with its details unturned.
        The first call with settling factors that system. Raises InputError for a handle that there is not,
        SolverError where there is not the memory, and what `progress` raises.
        """
        count = self._edit.handle_count
        chosen = range(count) if handles is None else [operator.index(h) for h in handles]
        if any(h < 0 for h in chosen):
            raise _core.InputError(f"handles: expected numbers from 0 to {count - 1}")
        return Response(*self._edit.response(list(chosen), progress))

    def __reduce__(self) -> Tuple[Any, ...]:
        mesh = self.mesh
        return (_prepared, (mesh.vertices, mesh.faces, self._step))

    def __repr__(self) -> str:
        return (
            f"Deformer({self.roi.size} vertices, {self._edit.handle_count} "
            f"{'handle' if self._edit.handle_count == 1 else 'handles'})"
        )


def _at_rest(handle: Any) -> Any:
    if isinstance(handle, dict) and "region" in handle:
        return {**handle, "move": {}}
    return {"region": handle, "move": {}}


def _prepared(vertices: Array, faces: Any, step: str) -> Deformer:
    deformer = Deformer.__new__(Deformer)
    deformer._prepare(_core.Mesh(vertices, faces), step, None)
    return deformer
