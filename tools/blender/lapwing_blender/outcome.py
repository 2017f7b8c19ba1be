# SPDX-License-Identifier: GPL-3.0-or-later
"""What an operation of the engine gives back."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import List

from .arrays import MeshArrays


@dataclass(frozen=True)
class Outcome:
    mesh: MeshArrays
    warnings: List[str] = field(default_factory=list)
