"""What the tests of the Python module share. CTest says where things are, in the environment."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import lapwing

#: Of the scan, as in tools/recipes/raise-arm.json.
ARM = {"disk": {"center": 969, "radius": 72}}
HAND = {"disk": {"center": 969, "radius": 27}}


@pytest.fixture(scope="session")
def source() -> Path:
    return Path(os.environ["LAPWING_SOURCE"])


@pytest.fixture(scope="session")
def cli() -> str:
    return os.environ["LAPWING_CLI"]


@pytest.fixture(scope="session")
def scan_file() -> Path:
    path = Path(os.environ["LAPWING_MODELS"]) / "cgal" / "meshes" / "armadillo.off"
    if not path.exists():
        if os.environ.get("CI") == "true":
            pytest.fail(f"{path} is missing; tools/setup/fetch-models brings it")
        pytest.skip(f"{path} is missing")
    return path


@pytest.fixture(scope="session")
def scan(scan_file: Path) -> lapwing.Mesh:
    return lapwing.read(scan_file)


@pytest.fixture(scope="session")
def tube() -> lapwing.Mesh:
    """An open tube along z, of a few hundred vertices."""
    return lapwing.remesh(lapwing.shape("cylinder"), scale=3.0).mesh


@pytest.fixture(scope="session")
def ends(tube: lapwing.Mesh):
    """The vertices at the lower and at the upper end of the tube."""
    z = tube.vertices[:, 2]
    low, high = z.min(), z.max()
    return np.flatnonzero(z < low + 0.1 * (high - low)), np.flatnonzero(z > high - 0.1 * (high - low))


def turned(degrees: float, translate=(0.0, 0.0, 0.0)) -> np.ndarray:
    """A turn about y, then a translation, as a matrix of shape (4, 4)."""
    angle = np.radians(degrees)
    matrix = np.eye(4)
    matrix[0, 0] = matrix[2, 2] = np.cos(angle)
    matrix[0, 2] = np.sin(angle)
    matrix[2, 0] = -np.sin(angle)
    matrix[:3, 3] = translate
    return matrix


def run(command, **options) -> str:
    done = subprocess.run(
        [str(part) for part in command], text=True, capture_output=True, check=False, **options
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}\n{done.stderr}"
    return done.stdout
