# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine as the Python module `lapwing`, in this process."""

from __future__ import annotations

import _thread
import json
import os
import tempfile
from contextlib import contextmanager
from typing import Any, Dict, Iterator, List, Mapping, Sequence, Tuple

import numpy as np

from .arrays import MeshArrays
from .engine import Outcome, Progress, in_words
from .errors import Cancelled, Refusal
from .ply import read_ply, write_ply
from .response import HandleFrame, columns_about


class ModuleEngine:
    name = "Python module"

    def __init__(self, module: Any, version: Tuple[int, ...]) -> None:
        self._module = module
        self.version = version

    @contextmanager
    def heard(self, progress: Progress) -> Iterator[Any]:
        """Yields the progress callback for the engine. Converts its errors to Refusal, and a
        cancellation to Cancelled."""
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
        # Pass polygons of different sizes as a file, because a list needs one array per polygon.
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder:
            path = os.path.join(folder, "mesh.ply")
            write_ply(path, mesh)
            return self._module.read(path)

    def prepare(
        self, mesh: MeshArrays, step: Mapping[str, Any], frames: Sequence[HandleFrame],
        progress: Progress,
    ) -> Tuple[np.ndarray, "PreparedEdit"]:
        """Returns the linear response to each parameter of `frames`, those of the first handles, as
        displacements (12 k, n, 3), and the edit that settles. Both share one preparation."""
        keys = {key: value for key, value in step.items() if key not in ("op", "handles")}
        with self.heard(progress) as hear:
            edit = self._module.Deformer(
                self._mesh(mesh), handles=list(step["handles"]), progress=hear, **keys
            )
            linear = edit.response(range(len(frames)), progress=hear)
        return columns_about(frames, linear.columns, linear.centers), PreparedEdit(self, edit)

    def grab_region(
        self, mesh: MeshArrays, vertex: int, radius: float, reach: float, progress: Progress
    ) -> np.ndarray:
        """Returns the vertices that move when the user pulls on `vertex`."""
        with self.heard(progress):
            return self._module.grab_region(self._mesh(mesh), vertex, radius, factor=reach).vertices

    def transfer(
        self, source: MeshArrays, poses: Sequence[np.ndarray], target: MeshArrays,
        landmarks: Sequence[Mapping[str, Any]], aligned: bool, progress: Progress,
    ) -> Tuple[List[np.ndarray], List[str]]:
        """Returns the target's vertices in each pose of the source, and the warnings."""
        with self.heard(progress) as hear:
            moved = self._module.transfer(
                self._mesh(source), np.stack(poses), self._mesh(target), list(landmarks),
                aligned=aligned, progress=hear,
            )
        return list(moved.vertices), [in_words(text) for text in moved.warnings]

    def run(
        self, mesh: MeshArrays, steps: Sequence[Mapping[str, Any]], others: Dict[str, MeshArrays],
        progress: Progress,
    ) -> Outcome:
        recipe = {"lapwing": 1, "mesh": "mesh.ply", "steps": list(steps)}
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder, self.heard(progress) as hear:
            # Pass the meshes as files, which preserve the material of each face if faces are
            # created.
            for name, each in {**others, "mesh.ply": mesh}.items():
                write_ply(os.path.join(folder, name), each)
            result = self._module.run(recipe, folder=folder, progress=hear)
            saved = os.path.join(folder, "result.ply")
            self._module.write(saved, result)
            made = read_ply(saved)
        steps = json.loads(result.report_json)["steps"]
        return Outcome(made, [in_words(text) for text in result.warnings], steps)


class PreparedEdit:
    """An edit that can be settled many times."""

    def __init__(self, engine: ModuleEngine, edit: Any) -> None:
        self._engine = engine
        self._edit = edit

    def settle(
        self, motions: Sequence[np.ndarray], free: Sequence[bool], progress: Progress
    ) -> Tuple[np.ndarray, List[str]]:
        """Returns the world coordinates (n, 3) and the warnings. Handles that are `free` have a
        free orientation."""
        with self._engine.heard(progress) as hear:
            result = self._edit.solve(np.stack(motions), free=list(free), progress=hear)
        return result.vertices, [in_words(text) for text in result.warnings]

    def close(self) -> None:
        # A large edit uses a gigabyte, and freeing it takes time, so use a thread. Thread.start
        # waits until the thread runs; start_new_thread does not.
        edits, self._edit = [self._edit], None
        _thread.start_new_thread(edits.clear, ())
