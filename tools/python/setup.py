"""Builds the extension of the wheel with CMake; everything else is in pyproject.toml.

LAPWING_BUILD_DIR names a folder that is built already, to take the extension from there. By default
each version of Python has a folder of its own in build/ at the project's root.
"""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parents[2]
INSTALL = "on Debian, tools/setup/install-packages --python installs all that the build needs"


def run(*command: object) -> None:
    if subprocess.run([str(part) for part in command], check=False).returncode != 0:
        sys.exit(f"lapwing: {command[0]} failed. The lines above say what is missing; {INSTALL}.")


def require_tools() -> None:
    """Exits with the names of all missing tools, rather than at the first in the middle of a build."""
    missing = [tool for tool in ("cmake", "glslangValidator") if shutil.which(tool) is None]
    if not any(shutil.which(tool) for tool in (os.environ.get("CXX", "c++"), "g++", "clang++")):
        missing.append("a C++ compiler")
    if not Path(sysconfig.get_path("include"), "Python.h").exists():
        missing.append(f"Python.h (headers of {sys.executable})")
    if missing:
        sys.exit(f"lapwing: the build needs {', '.join(missing)}; {INSTALL}.")


def require_wheel() -> None:
    """Exits if setuptools needs the package wheel to make a wheel, and it is missing."""
    has_command = importlib.util.find_spec("setuptools.command.bdist_wheel") is not None
    if not has_command and importlib.util.find_spec("wheel") is None:
        sys.exit(
            f"lapwing: {sys.executable} has no package wheel. Make the virtual environment with "
            "--system-site-packages, run pip without --no-build-isolation, or install wheel."
        )


class CMakeBuild(build_ext):
    def build_extension(self, ext: Extension) -> None:
        require_tools()
        given = os.environ.get("LAPWING_BUILD_DIR")
        tag = sysconfig.get_config_var("SOABI") or sys.implementation.cache_tag
        build = Path(given).resolve() if given else ROOT / "build" / f"wheel-{tag}"
        if not given:
            run(
                "cmake", "-S", ROOT, "-B", build, "-DCMAKE_BUILD_TYPE=Release",
                "-DLAPWING_BUILD_PYTHON=ON", "-DLAPWING_BUILD_TOOLS=OFF",
                "-DLAPWING_BUILD_TESTS=OFF", "-DLAPWING_BUILD_VIEWER=OFF",
                f"-DPython_EXECUTABLE={sys.executable}",
            )
        run("cmake", "--build", build, "--parallel", os.cpu_count(), "--target", "lapwing_python")
        target = Path(self.get_ext_fullpath(ext.name))
        built = build / "python" / "lapwing" / target.name
        if not built.exists():
            sys.exit(
                f"lapwing: {build} builds for another Python than {sys.executable}: it has no "
                f"{target.name}. Set LAPWING_BUILD_DIR to another folder, or unset it."
            )
        target.parent.mkdir(parents=True, exist_ok=True)
        self.copy_file(str(built), str(target))


require_wheel()
version = re.search(r"project\(lapwing VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())
assert version is not None
setup(
    version=version.group(1),
    ext_modules=[Extension("lapwing._core", sources=[])],
    cmdclass={"build_ext": CMakeBuild},
)
