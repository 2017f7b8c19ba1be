# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine as the Python module `lapwing`, in this process."""

from __future__ import annotations

import json
import os
import tempfile
from contextlib import contextmanager
from typing import Any, Callable, Dict, Iterator, List, Mapping, Sequence, Tuple

import numpy as np

from .arrays import MeshArrays
from .engine import Progress
from .errors import Cancelled, Refusal
from .outcome import Outcome, in_words
from .ply import read_ply, write_ply


class ModuleEngine:
    name = "Python module"

    def __init__(self, module: Any, version: Tuple[int, ...]) -> None:
        self._module = module
        self.version = version

    @contextmanager
    def heard(self, progress: Progress) -> Iterator[Any]:
        """What the engine reports to; its errors come out as Refusal, a cancel as Cancelled."""
        stopped = False

        def hear(stage: str, fraction: float) -> bool:
            nonlocal stopped
            stopped = stopped or not progress(stage, fraction)
            return not stopped

        try:
            yield hear
        except self._module.Error as error:
            if stopped:
                raise Cancelled() from error
            raise Refusal(in_words(str(error))) from error

    def _mesh(self, mesh: MeshArrays) -> Any:
        corners = mesh.sizes[0]
        if (mesh.sizes == corners).all():
            return self._module.Mesh(mesh.vertices, mesh.corners.reshape(-1, corners))
        # A list of polygons takes an array for each; a file takes none.
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder:
            path = os.path.join(folder, "mesh.ply")
            write_ply(path, mesh)
            return self._module.read(path)

    def prepare(
        self, mesh: MeshArrays, step: Mapping[str, Any], motions: np.ndarray, progress: Progress
    ) -> Tuple[np.ndarray, "PreparedEdit"]:
        """The linear response to each of `motions` (k, handles, 4, 4) as displacements (k, n, 3),
        and the edit that settles. Its factorization goes before that edit makes its own."""
        keys = {key: value for key, value in step.items() if key not in ("op", "handles")}
        handles = list(step["handles"])
        moved = np.empty((0, *mesh.vertices.shape))
        with self.heard(progress) as hear:
            taken = self._mesh(mesh)
            if len(motions):
                linear = self._module.Deformer(
                    taken, handles=handles, progress=hear, **{**keys, "settle": False}
                )
                moved = linear.solve_many(motions, threads=1, progress=hear).vertices
                moved -= mesh.vertices

        def prepared(hear: Any) -> Any:
            return self._module.Deformer(taken, handles=handles, progress=hear, **keys)

        return moved, PreparedEdit(self, prepared)

    def run(
        self, mesh: MeshArrays, steps: Sequence[Mapping[str, Any]], others: Dict[str, MeshArrays],
        progress: Progress,
    ) -> Outcome:
        recipe = {"lapwing": 1, "mesh": "mesh.ply", "steps": list(steps)}
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder, self.heard(progress) as hear:
            # Files keep the material of each face through an edit that makes faces.
            for name, each in {**others, "mesh.ply": mesh}.items():
                write_ply(os.path.join(folder, name), each)
            result = self._module.run(
                json.loads(json.dumps(recipe)), folder=folder, progress=hear
            )
            saved = os.path.join(folder, "result.ply")
            self._module.write(saved, result)
            made = read_ply(saved)
        return Outcome(made, [in_words(text) for text in result.warnings])

    def peel(
        self, mesh: MeshArrays, region: Mapping[str, Any], detail_size: float, progress: Progress
    ) -> Outcome:
        with self.heard(progress):
            peeled = self._module.peel(self._mesh(mesh), detail_size=detail_size, region=region)
        made = MeshArrays(peeled.vertices, mesh.corners, mesh.sizes, mesh.materials)
        return Outcome(made, [in_words(text) for text in peeled.warnings])


class PreparedEdit:
    """An edit that is settled again and again. What settling needs is prepared the first time, so
    that the handles can be moved before."""

    def __init__(self, engine: ModuleEngine, prepared: Callable[[Any], Any]) -> None:
        self._engine = engine
        self._prepared = prepared
        self._edit: Any = None

    def settle(
        self, motions: Sequence[np.ndarray], progress: Progress
    ) -> Tuple[np.ndarray, List[str]]:
        """World coordinates (n, 3), and what is to be said of them."""
        with self._engine.heard(progress) as hear:
            if self._edit is None:
                self._edit = self._prepared(hear)
            result = self._edit.solve(np.stack(motions), progress=hear)
        return result.vertices, [in_words(text) for text in result.warnings]

    def close(self) -> None:
        self._edit = None
