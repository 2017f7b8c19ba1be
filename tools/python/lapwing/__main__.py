"""Runs recipes and prints their keys: python -m lapwing."""

from __future__ import annotations

import argparse
import signal
import sys

import lapwing
from lapwing import _core


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m lapwing", description=__doc__)
    parser.add_argument("--version", action="version", version=f"lapwing {_core.__version__}")
    commands = parser.add_subparsers(dest="command", required=True)
    run = commands.add_parser("run", help="run a recipe and write its result to its \"save\"")
    run.add_argument("recipe", help="a JSON file")
    run.add_argument("--device", default="cpu", help="cpu, auto or a part of a device's name")
    keys = commands.add_parser("keys", help="print the keys of an operation, or of all")
    keys.add_argument("operation", nargs="?", choices=_core.operations())
    arguments = parser.parse_args()
    if arguments.command == "keys":
        print(lapwing.keys(arguments.operation))
        return 0
    try:
        result = lapwing.run(arguments.recipe, device=arguments.device, save=True)
    except lapwing.Error as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    for line in result.notes:
        print(f"note: {line}", file=sys.stderr)
    for line in result.warnings:
        print(f"warning: {line}", file=sys.stderr)
    print(result)
    return 0


if __name__ == "__main__":
    # Python ignores this signal. By default it ends a program whose output nobody reads any more,
    # as in `python -m lapwing keys | head`.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    sys.exit(main())
