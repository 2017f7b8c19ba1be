# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the engine: the Python module `lapwing`, or else the program. What both return."""

from __future__ import annotations

import importlib
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass, field
from typing import Any, Callable, Dict, List, Optional, Tuple

from .arrays import MeshArrays
from .errors import Refusal

#: Major and minor version of the engine that this add-on needs.
VERSION = (0, 1)

Progress = Callable[[str, float], bool]

#: The beginning of the engine's messages: the file or step, and the JSON pointer. The add-on
#: removes it, because the user does not see the recipe.
_PLACE = re.compile(r"^(note: )?((\w+\.json|recipe|Deformer|deform|peel|step \d+): )*(/[\w/]*: )?")

_found: dict = {}


@dataclass(frozen=True)
class Outcome:
    """The result of an operation of the engine."""

    mesh: MeshArrays
    warnings: List[str] = field(default_factory=list)
    steps: List[Dict[str, Any]] = field(default_factory=list)  #: the engine's report of each step


def in_words(message: str) -> str:
    """Returns a message of the engine as one sentence for Blender's report."""
    words = _PLACE.sub("", " ".join(message.split()))
    return words[:1].upper() + words[1:]


def engine(path: str = "") -> Any:
    """Returns the engine at the preferred `path`, or else the module, or else the program on PATH.
    The result is cached. Refusal says why there is none; the next call then looks again."""
    if isinstance(_found.get(path), Refusal):
        del _found[path]
    found = last_look(path)
    if isinstance(found, Refusal):
        raise found
    return found


def last_look(path: str = "") -> Any:
    """Returns the engine or the Refusal of the last search, for a panel that is redrawn often."""
    if path not in _found:
        try:
            _found[path] = _find(path)
        except Refusal as refusal:
            _found[path] = refusal
    return _found[path]


def forget() -> None:
    """Makes the next call look again, after preferences changed or a program was installed."""
    _found.clear()


def _find(path: str) -> Any:
    from .engine_module import ModuleEngine
    from .engine_program import ProgramEngine

    chosen = os.path.abspath(os.path.expanduser(path)) if path else ""
    if chosen and not os.path.exists(chosen):
        raise Refusal(
            f"There is no engine at {chosen}; correct the path in the add-on's preferences"
        )
    if chosen and os.path.isfile(chosen):
        return ProgramEngine(chosen, _checked(_program_version(chosen), chosen))
    module, why = _imported(chosen)
    if module is not None:
        place = os.path.dirname(module.__file__)
        if chosen and not _is_below(place, chosen):
            why = f"another one, of {place}, is loaded, which takes a restart of Blender to change"
        else:
            return ModuleEngine(module, _checked(_numbers(module.__version__), place))
    for program in _programs(chosen):
        return ProgramEngine(program, _checked(_program_version(program), program))
    if chosen:
        raise Refusal(
            f"The engine in {chosen} cannot be used ({why}); set the path in the add-on's "
            "preferences to the folder of the module 'lapwing' for this Python, or to the program"
        )
    raise Refusal(
        "The Lapwing engine was not found; install the module 'lapwing' for Blender's Python, or "
        "set its path or that of the program in the add-on's preferences"
    )


def _imported(folder: str) -> Tuple[Optional[Any], str]:
    if folder and not os.path.isdir(os.path.join(folder, "lapwing")):
        return None, "it holds no folder 'lapwing'"
    if folder:
        sys.path.insert(0, folder)
    try:
        module = importlib.import_module("lapwing")
        module.__version__, module.Deformer  # fails if this is another module named `lapwing`
        return module, ""
    except Exception as error:  # even if the module is broken, the program may work
        sys.modules.pop("lapwing", None)
        return None, " ".join(str(error).split()) or type(error).__name__
    finally:
        if folder:
            sys.path.remove(folder)


def _programs(folder: str) -> List[str]:
    if not folder:
        found = shutil.which("lapwing")
        return [found] if found else []
    name = "lapwing.exe" if os.name == "nt" else "lapwing"
    places = (os.path.join(folder, name), os.path.join(folder, "bin", name))
    return [place for place in places if os.path.isfile(place) and os.access(place, os.X_OK)]


def _program_version(program: str) -> Tuple[int, ...]:
    try:
        done = subprocess.run(
            [program, "--version"], capture_output=True, text=True, timeout=20, check=False
        )
    except (OSError, subprocess.TimeoutExpired, UnicodeDecodeError) as error:
        raise Refusal(
            f"{program} cannot be started ({type(error).__name__}); set the path in the add-on's "
            "preferences to the program 'lapwing'"
        ) from error
    return _numbers(done.stdout if done.returncode == 0 else "")


def _numbers(version: str) -> Tuple[int, ...]:
    parts = version.strip().split()[-1:] or [""]
    return tuple(int(part) for part in parts[0].split(".") if part.isdigit())


def _checked(version: Tuple[int, ...], place: str) -> Tuple[int, ...]:
    if version[:2] == VERSION:
        return version
    wanted = ".".join(map(str, VERSION))
    found = ".".join(map(str, version)) or "unknown"
    raise Refusal(
        f"The engine at {place} is of version {found}, and this add-on needs {wanted}; install "
        "both from the same release"
    )


def _is_below(place: str, folder: str) -> bool:
    return os.path.realpath(place).startswith(os.path.join(os.path.realpath(folder), ""))
