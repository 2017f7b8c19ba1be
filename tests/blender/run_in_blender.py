#!/usr/bin/python3
"""Runs a file of tests in Blender with separate settings: without a window, except window_test.py,
which gets a virtual display drawn by the CPU.

    run_in_blender.py edit_test.py [TEST...]
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SKIPPED = 77


def main() -> int:
    blender = shutil.which("blender")
    if blender is None:
        missing = "Blender is missing; tools/setup/install-packages --blender brings it"
        if os.environ.get("CI") == "true":
            print(missing, file=sys.stderr)
            return 1
        print(f"Skipped: {missing}")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="lapwing-blender-") as folder:
        addon = os.path.join(folder, "addon.zip")
        subprocess.run([HERE.parents[1] / "tools/pack-addon", addon], check=True,
                       stdout=subprocess.DEVNULL)
        environment = {
            **os.environ,
            "BLENDER_USER_CONFIG": os.path.join(folder, "config"),
            "BLENDER_USER_SCRIPTS": os.path.join(folder, "scripts"),
            "LAPWING_ADDON": addon, "LAPWING_WORK": os.path.join(folder, "work"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        environment.pop("PYTHONPATH", None)
        os.mkdir(os.path.join(folder, "work"))
        command = [blender, "--factory-startup", "-noaudio", "--python-exit-code", "1",
                   "--python-expr", f"import sys; sys.path.insert(0, {str(HERE)!r})",
                   "--python", sys.argv[1], "--", *sys.argv[2:]]
        if Path(sys.argv[1]).name == "window_test.py":
            environment["LIBGL_ALWAYS_SOFTWARE"] = "1"
            command[1:1] = ["--enable-event-simulate", "--window-geometry", "0", "0", "1280", "800"]
            command = ["xvfb-run", "--auto-servernum", "--server-args=-screen 0 1280x800x24", *command]
        else:
            command.insert(1, "--background")
        return subprocess.run(command, env=environment, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
