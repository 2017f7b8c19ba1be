"""Builds the extension of the wheel with CMake; everything else is in pyproject.toml.

LAPWING_BUILD_DIR names the build folder, whose existing build is reused; the default is build/wheel
at the project's root.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        build = Path(os.environ.get("LAPWING_BUILD_DIR", ROOT / "build" / "wheel")).resolve()
        if not (build / "CMakeCache.txt").exists():
            subprocess.run(
                [
                    "cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                    "-DLAPWING_BUILD_PYTHON=ON", "-DLAPWING_BUILD_TOOLS=OFF",
                    "-DLAPWING_BUILD_TESTS=OFF", "-DLAPWING_BUILD_VIEWER=OFF",
                    f"-DPython_EXECUTABLE={sys.executable}",
                ],
                check=True,
            )
        subprocess.run(
            ["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target",
             "lapwing_python"],
            check=True,
        )
        target = Path(self.get_ext_fullpath(ext.name))
        built = build / "python" / "lapwing" / target.name
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


version = re.search(r"project\(lapwing VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
assert version is not None
setup(
    version=version.group(1),
    ext_modules=[Extension("lapwing._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
