# SPDX-License-Identifier: GPL-3.0-or-later
"""The result of an operation of the engine."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import List

from .arrays import MeshArrays


@dataclass(frozen=True)
class Outcome:
    mesh: MeshArrays
    warnings: List[str] = field(default_factory=list)


#: The file or step, and the place in it, at the beginning of the engine's messages. A user who
#: pressed a button does not know the recipe.
_PLACE = re.compile(r"^(note: )?((\w+\.json|recipe|Deformer|deform|peel|step \d+): )*(/[\w/]*: )?")


def in_words(message: str) -> str:
    """Returns a message of the engine as one sentence for Blender's report."""
    words = _PLACE.sub("", " ".join(message.split()))
    return words[:1].upper() + words[1:]
