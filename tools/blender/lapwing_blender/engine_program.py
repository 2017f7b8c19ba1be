# SPDX-License-Identifier: GPL-3.0-or-later
"""The engine as the program `lapwing`: recipes and files in a temporary folder."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import tempfile
from dataclasses import replace
from typing import Any, Dict, List, Mapping, Sequence, Tuple

import numpy as np

from .arrays import MeshArrays
from .engine import Outcome, Progress, in_words
from .errors import Cancelled, Refusal
from .ply import read_ply, write_ply
from .response import HandleFrame, moved_handles, unit_motions

_POLL_SECONDS = 0.03


class ProgramEngine:
    name = "program"

    def __init__(self, program: str, version: Tuple[int, ...]) -> None:
        self._program = program
        self.version = version

    def call(self, folder: str, arguments: Sequence[str], progress: Progress) -> str:
        """Returns the program's standard error. An interrupt lets the program remove its files."""
        log_path = os.path.join(folder, "log.txt")
        with open(log_path, "wb") as log:
            try:
                running = subprocess.Popen(
                    [self._program, *arguments], cwd=folder, stdin=subprocess.DEVNULL,
                    stdout=subprocess.DEVNULL, stderr=log,
                )
            except OSError as error:
                raise Refusal(
                    f"{self._program} cannot be started ({error.strerror}); set the path in the "
                    "add-on's preferences to the program 'lapwing'"
                ) from error
            while True:
                try:
                    code = running.wait(_POLL_SECONDS)
                    break
                except subprocess.TimeoutExpired:
                    pass
                if not progress(arguments[0], 0.0):
                    if os.name == "nt":
                        running.terminate()
                    else:
                        running.send_signal(signal.SIGINT)
                    running.wait()
                    raise Cancelled()
        with open(log_path, encoding="utf-8", errors="replace") as log:
            said = log.read()
        if code != 0:
            raise Refusal(
                in_words(_first_failure(folder) or _last_message(said))
                or f"The program lapwing ended with code {code}; try again"
            )
        return said

    def prepare(
        self, mesh: MeshArrays, step: Mapping[str, Any], frames: Sequence[HandleFrame],
        progress: Progress,
    ) -> Tuple[np.ndarray, "PreparedEdit"]:
        """Returns the linear response to each parameter of `frames`, those of the first handles, as
        displacements (12 k, n, 3), one solve each, and the edit that settles."""
        edit = PreparedEdit(self, mesh, step)
        try:
            return edit.linear(unit_motions(frames, len(step["handles"])), progress), edit
        except BaseException:
            edit.close()
            raise

    def grab_region(
        self, mesh: MeshArrays, vertex: int, radius: float, reach: float, progress: Progress
    ) -> np.ndarray:
        raise Refusal(
            "Lapwing Grab needs the engine as a Python module; set the path in the add-on's "
            "preferences to the folder of the module 'lapwing'"
        )

    def transfer(
        self, source: MeshArrays, poses: Sequence[np.ndarray], target: MeshArrays,
        landmarks: Sequence[Mapping[str, Any]], aligned: bool, progress: Progress,
    ) -> Tuple[List[np.ndarray], List[str]]:
        """Returns the target's vertices in each pose of the source, and the warnings."""
        names = [f"{k:05}.ply" for k in range(len(poses))]
        arguments = ["transfer", "rest.ply", "poses", "--onto", "target.ply", "-o", "posed"]
        arguments += ["--aligned"] if aligned else []
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder:
            os.mkdir(os.path.join(folder, "poses"))
            write_ply(os.path.join(folder, "rest.ply"), source)
            write_ply(os.path.join(folder, "target.ply"), target)
            for name, vertices in zip(names, poses):
                pose = replace(source, vertices=vertices)
                write_ply(os.path.join(folder, "poses", name), pose)
            if landmarks:
                _write_json(os.path.join(folder, "landmarks.json"), list(landmarks))
                arguments += ["--landmarks", "landmarks.json"]
            said = self.call(folder, arguments, progress)
            warning = "lapwing: warning: "
            warnings = [
                in_words(line[len(warning):]) for line in said.splitlines()
                if line.startswith(warning)
            ]
            return [
                read_ply(os.path.join(folder, "posed", name), vertices_only=True).vertices
                for name in names
            ], warnings

    def run(
        self, mesh: MeshArrays, steps: Sequence[Mapping[str, Any]], others: Dict[str, MeshArrays],
        progress: Progress,
    ) -> Outcome:
        with tempfile.TemporaryDirectory(prefix="lapwing-") as folder:
            for name, each in {**others, "mesh.ply": mesh}.items():
                write_ply(os.path.join(folder, name), each)
            _write_json(os.path.join(folder, "recipe.json"), _recipe(steps))
            warnings, steps = self.run_recipe(folder, "recipe.json", progress)
            return Outcome(read_ply(os.path.join(folder, "result.ply")), warnings, steps)

    def run_recipe(
        self, folder: str, name: str, progress: Progress
    ) -> Tuple[List[str], List[Dict[str, Any]]]:
        """Runs a recipe. Returns the warnings and the steps of its report."""
        self.call(
            folder, ["run", name, "--device", "cpu", "--report", "report.json"], progress
        )
        with open(os.path.join(folder, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        return [in_words(text) for text in report.get("warnings", [])], report["steps"]


class PreparedEdit:
    """An edit whose mesh is in its own folder until `close`."""

    def __init__(self, engine: ProgramEngine, mesh: MeshArrays, step: Mapping[str, Any]) -> None:
        self._engine = engine
        self._step = dict(step)
        self._rest = mesh.vertices
        self._folder = tempfile.TemporaryDirectory(prefix="lapwing-")
        write_ply(self._path("mesh.ply"), mesh)

    def _path(self, name: str) -> str:
        return os.path.join(self._folder.name, name)

    def linear(self, motions: np.ndarray, progress: Progress) -> np.ndarray:
        if len(motions) == 0:
            return np.empty((0, *self._rest.shape))
        _write_json(self._path("linear.json"), _recipe([{**self._step, "settle": False}]))
        with open(self._path("jobs.jsonl"), "w", encoding="utf-8") as jobs:
            for k, of_handles in enumerate(motions):
                moves = {
                    f"/steps/0/handles/{h}/move": {"matrix": matrix.ravel().tolist()}
                    for h, matrix in enumerate(of_handles)
                }
                jobs.write(json.dumps({"id": f"m{k}", "set": moves}) + "\n")
        self._engine.call(
            self._folder.name,
            ["batch", "jobs.jsonl", "--recipe", "linear.json", "-o", "linear", "--displacements",
             "float64", "--threads", "1"],
            progress,
        )
        return np.stack([np.load(self._path(f"linear/m{k}.npy")) for k in range(len(motions))])

    def settle(
        self, motions: Sequence[np.ndarray], free: Sequence[bool], progress: Progress
    ) -> Tuple[np.ndarray, List[str]]:
        """Returns the world coordinates (n, 3) and the warnings. Handles that are `free` have a
        free orientation."""
        handles = moved_handles(self._step["handles"], motions, free)
        _write_json(self._path("settle.json"), _recipe([{**self._step, "handles": handles}]))
        warnings, _steps = self._engine.run_recipe(self._folder.name, "settle.json", progress)
        made = read_ply(self._path("result.ply"), vertices_only=True)
        return made.vertices, warnings

    def close(self) -> None:
        self._folder.cleanup()


def _recipe(steps: Sequence[Mapping[str, Any]]) -> Dict[str, Any]:
    return {"lapwing": 1, "mesh": "mesh.ply", "steps": list(steps), "save": "result.ply"}


def _write_json(path: str, value: Any) -> None:
    with open(path, "w", encoding="utf-8") as file:
        json.dump(value, file)


def _last_message(said: str) -> str:
    lines = [line for line in said.splitlines() if line.startswith("lapwing: ")]
    return lines[-1][len("lapwing: "):] if lines else ""


def _first_failure(folder: str) -> str:
    """Returns the reason why a batch failed, which it writes beside its results."""
    path = os.path.join(folder, "linear", "failed.jsonl")
    if not os.path.exists(path):
        return ""
    with open(path, encoding="utf-8") as failed:
        message = str(json.loads(failed.readline())["error"])
    return message.partition("(linear.json): ")[2] or message
