# SPDX-License-Identifier: GPL-3.0-or-later
"""The linear response of the surface to its handles, as columns that a frame adds up.

The engine's linear response is affine in the twelve numbers of a handle's matrix. With a column for
each of them, a frame costs one product of a thin matrix with a vector.
"""

from __future__ import annotations

from typing import Any, Dict, List, Mapping, Sequence

import numpy as np

PARAMETERS = 12
#: A handle whose rotation, scaling and translation (relative to the region's size) are smaller is
#: at rest.
_AT_REST = 2e-6


class HandleFrame:
    """The centre of a handle's motions, and the size of the edit, which brings rotations and
    translations to the same scale."""

    def __init__(self, points: np.ndarray, length: float) -> None:
        self.centroid = points.mean(axis=0)
        self.length = length

    def parameters(self, motion: np.ndarray) -> np.ndarray:
        linear = motion[:3, :3] - np.eye(3)
        shift = linear @ self.centroid + motion[:3, 3]
        return np.column_stack([linear, shift / self.length]).ravel()

    def is_shift(self, motion: np.ndarray) -> bool:
        """Returns whether the motion is a translation, to Blender's single precision."""
        linear = np.abs(motion[:3, :3] - np.eye(3)).max()
        return bool(linear < _AT_REST)

    def is_rest(self, motion: np.ndarray) -> bool:
        """Returns whether the handle is at rest, to Blender's single precision."""
        far = 1.0 + np.abs(self.centroid).max() / self.length
        return bool(np.abs(self.parameters(motion)).max() < _AT_REST * far)

    def unit_motion(self, parameter: int) -> np.ndarray:
        """Returns the motion whose parameters are all 0 except for this one, which is 1."""
        row, column = divmod(parameter, 4)
        motion = np.eye(4)
        if column < 3:
            motion[row, column] += 1.0
            motion[row, 3] -= self.centroid[column]
        else:
            motion[row, 3] = self.length
        return motion


def unit_motions(frames: Sequence[HandleFrame], handles: int) -> np.ndarray:
    """Returns unit motions of shape (12 len(frames), handles, 4, 4): one for each parameter of the
    first handles, with all other handles at rest."""
    motions = np.tile(np.eye(4), (PARAMETERS * len(frames), handles, 1, 1))
    for k, frame in enumerate(frames):
        for p in range(PARAMETERS):
            motions[PARAMETERS * k + p, k] = frame.unit_motion(p)
    return motions


def columns_about(
    frames: Sequence[HandleFrame], columns: np.ndarray, centers: np.ndarray
) -> np.ndarray:
    """Returns columns of shape (12 len(frames), n, 3), one for each parameter of `frames`. Converts
    them from the module's `columns` of shape (len(frames), 3, 4, n, 3) about its own `centers`."""
    for k, frame in enumerate(frames):
        for b, offset in enumerate(centers[k] - frame.centroid):
            if offset != 0.0:
                columns[k, :, b] += offset * columns[k, :, 3]
        columns[k, :, 3] *= frame.length
    return columns.reshape(PARAMETERS * len(frames), *columns.shape[3:])


class Response:
    """Computes the coordinates of the whole mesh in the object's space from motions in the world.

    `rest` (in the object's space), `rest_world` and `to_local` are from the time of preparation.
    `columns` of shape (12 handles, n, 3) are displacements in the world.
    """

    def __init__(
        self, frames: List[HandleFrame], rest: np.ndarray, rest_world: np.ndarray,
        columns: np.ndarray, to_local: np.ndarray,
    ) -> None:
        self._frames = frames
        self._rest = rest
        self._rest_world = rest_world
        self._to_local = to_local
        self.moving = np.flatnonzero(columns.any(axis=(0, 2)))
        local = columns[:, self.moving] @ to_local[:3, :3].T
        self._columns = np.ascontiguousarray(
            local.reshape(len(columns), -1).T.astype(np.float32)
        )
        self._coordinates = rest.astype(np.float32)
        self.set_pose(None, None)

    def set_pose(self, motions: Sequence[np.ndarray] | None, world: np.ndarray | None) -> None:
        """Makes later frames start at the surface `world`, settled for `motions`; None is rest."""
        if motions is None or world is None:
            self._of_pose = np.zeros(PARAMETERS * len(self._frames))
            self._base = self._rest[self.moving].astype(np.float32)
            return
        self._of_pose = self._parameters(motions)
        moved = world[self.moving]
        points = moved @ self._to_local[:3, :3].T + self._to_local[:3, 3]
        # Copy the coordinates of points at rest, because conversions would cause rounding errors.
        still = (moved == self._rest_world[self.moving]).all(axis=1, keepdims=True)
        self._base = np.where(still, self._rest[self.moving], points).astype(np.float32)

    def _parameters(self, motions: Sequence[np.ndarray]) -> np.ndarray:
        return np.concatenate(
            [frame.parameters(motion) for frame, motion in zip(self._frames, motions)]
        )

    def coordinates(self, motions: Sequence[np.ndarray]) -> np.ndarray:
        """Returns the coordinates (n, 3), float32, valid until the next call."""
        change = (self._parameters(motions) - self._of_pose).astype(np.float32)
        moved = (self._columns @ change).reshape(-1, 3)
        moved += self._base
        self._coordinates[self.moving] = moved
        return self._coordinates


def moved_handles(
    handles: Sequence[Mapping[str, Any]], motions: Sequence[np.ndarray], free: Sequence[bool]
) -> List[Dict[str, Any]]:
    """Returns the handles of a recipe's step with their motions. Those in `free` get a free
    orientation."""
    return [
        {
            **handle,
            "move": {"matrix": motion.ravel().tolist()},
            **({"orientation": "free"} if is_free else {}),
        }
        for handle, motion, is_free in zip(handles, motions, free)
    ]
