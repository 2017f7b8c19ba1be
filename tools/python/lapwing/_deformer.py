"""An edit that is prepared once and solved for many motions."""

from __future__ import annotations

import operator
from typing import Any, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arguments import mesh_of, targets_and
from ._operations import deform_step
from ._types import (
    Array,
    FacesLike,
    Landmarks,
    LinearResponse,
    Loose,
    MeshOrVertices,
    Progress,
    Region,
    Seams,
    Weights,
)


class Many(NamedTuple):
    """Result of `Deformer.solve_many`."""

    #: Shape (k, n, 3), of the requested type, float64 or float32.
    vertices: Array
    #: One certificate for each motion.
    certificates: List[_core.Certificate]


class Response(NamedTuple):
    """Linear response of the surface to handles, returned by `Deformer.response`."""

    #: Shape (k, 3, 4, n, 3): columns[h, a, b] are the displacements of all vertices if entry (a, b)
    #: of the motion of handle h, about its centre, increases by one. [:, :, :3] has the unit of the
    #: mesh; [:, :, 3] is a displacement per length and has no unit.
    columns: Array
    #: Shape (k, 3): centroid of each handle's vertices, in the mesh's coordinates.
    centers: Array
    #: If the exact system needs too much memory, a message; details then do not rotate.
    why_not_exact: str = ""

    def displacements(self, motions: Any) -> Array:
        """Returns the displacements (n, 3) from rest for one motion of each of the k handles:
        matrices of shape (k, 4, 4) or (k, 3, 4), as for `Deformer.solve`."""
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
    """A region and its handles, prepared once for any number of motions.

        d = lapwing.Deformer(V, F, roi=roi, belt=0.1, handles=[hand])
        raised = d.solve([matrix])              # one motion per handle
        many = d.solve_many(matrices)           # shape (k, handles, 4, 4), on all threads

    `handles` are regions, or dicts with "region" and "weight" or "falloff". All other arguments
    (`roi`, `belt`, `targets`, `landmarks`, `stiffness`, `mirror`, `hard`, `detail_length`,
    `constraint_weight`, `settle`, `weights`, `response`, `loose`, `seams`, `progress`) are as in
    `lapwing.deform`, and the results have the same bits. Preparing takes tens of milliseconds for ten thousand vertices, and about 8 kB of memory per vertex. Threads can share
    a Deformer; their calls take turns. A pickled Deformer prepares itself again when it is
    unpickled, for example on a worker of a cluster.
    """

    def __init__(
        self,
        mesh: MeshOrVertices,
        faces: Optional[FacesLike] = None,
        roi: Region = "all",
        belt: Union[float, Region, None] = None,
        handles: Sequence[Region] = (),
        *,
        targets: Any = None,
        landmarks: Optional[Landmarks] = None,
        stiffness: Any = None,
        mirror: Union[str, Mapping[str, Any], None] = None,
        hard: Optional[bool] = None,
        detail_length: Optional[float] = None,
        constraint_weight: Optional[float] = None,
        settle: Union[bool, Mapping[str, Any], None] = None,
        weights: Optional[Weights] = None,
        response: Optional[LinearResponse] = None,
        loose: Optional[Loose] = None,
        seams: Optional[Seams] = None,
        progress: Progress = None,
    ) -> None:
        chosen = mesh_of(mesh, faces, "Deformer: mesh")
        keys = dict(
            roi=roi, belt=belt, targets=targets_and(landmarks, targets, "Deformer"), mirror=mirror, hard=hard,
            stiffness=stiffness,
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
        """The vertices of `roi` that stay."""
        return self._edit.belt

    @property
    def handles(self) -> List[Array]:
        """The vertices of each handle."""
        return self._edit.handles

    def solve(
        self, motions: Any, *, free: Optional[Sequence[bool]] = None, progress: Progress = None
    ) -> _core.Result:
        """Returns the settled surface for one motion per handle: matrices of shape (handles, 4, 4)
        or (handles, 3, 4) that act on column vectors at rest. With one handle, a single matrix is
        enough. `free` says for each handle whether its orientation is free; the default is that of
        the handles."""
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
        """Returns the settled surfaces for `motions` of shape (k, handles, 4, 4): `vertices` of
        shape (k, n, 3) and type `dtype`, float64 or float32, and a certificate for each motion.

        Runs on `threads` threads, by default all. Each thread except the first prepares again, in
        its own memory. The bits do not depend on the number of threads.
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
        """Returns the linear response to `handles`, by default all: 12 columns per handle. Adding
        them up for a frame of a drag takes microseconds per thousand vertices.

            linear = d.response()
            shown = V + linear.displacements([matrix])

        `handles` are numbers from 0. The columns cost 12 right-hand sides per handle and take 288
        bytes per vertex and handle. V + `displacements` equals the result of a Deformer with
        `settle=False` to 1e-6 of the diagonal, except for loose parts, which rotate here only to
        first order. Targets are left out, and images of mirrored handles move along. If the region
        is too large for the exact system (see `why_not_exact`), its details do not rotate. With
        settling, the first call factorizes that system. Raises InputError for a handle that does
        not exist, SolverError if there is not enough memory, and what `progress` raises.
        """
        count = self._edit.handle_count
        chosen = range(count) if handles is None else [operator.index(h) for h in handles]
        if any(h < 0 for h in chosen):
            raise _core.InputError(f"handles: expected numbers from 0 to {count - 1}")
        return Response(*self._edit.response(list(chosen), progress))

    def __reduce__(self) -> Tuple[Any, ...]:
        return (_prepared, (self.mesh, self._step))

    def __repr__(self) -> str:
        return (
            f"Deformer({self.roi.size} vertices, {self._edit.handle_count} "
            f"{'handle' if self._edit.handle_count == 1 else 'handles'})"
        )


def _at_rest(handle: Any) -> Any:
    if isinstance(handle, dict) and "region" in handle:
        return {**handle, "move": {}}
    return {"region": handle, "move": {}}


def _prepared(mesh: _core.Mesh, step: str) -> Deformer:
    deformer = Deformer.__new__(Deformer)
    deformer._prepare(mesh, step, None)
    return deformer
