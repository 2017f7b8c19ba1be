"""Pictures without a display."""

from __future__ import annotations

from typing import Any, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._arguments import Array, mesh_of


def render(
    mesh: Any,
    faces: Any = None,
    *,
    values: Any = None,
    limits: Optional[Tuple[float, float]] = None,
    legend: str = "",
    size: Tuple[int, int] = (640, 480),
    view: str = "three-quarter",
    from_: Optional[Sequence[float]] = None,
    up: str = "y",
    background: str = "white",
    orthographic: bool = False,
    wireframe: bool = False,
    flat: bool = False,
    device: str = "auto",
) -> Array:
    """Returns a picture of a mesh, (height, width, 4) uint8, for `matplotlib.pyplot.imshow`.

    `values`, one per vertex, colour the mesh, with a legend over `limits`, by default from the
    smallest to the largest value; NaN has no colour. `view` is "three-quarter", "front", "back",
    "left", "right", "top" or "bottom"; `from_`, a direction to the eye, replaces it. Needs Vulkan;
    Mesa's software device is enough. DeviceError says what to install.
    """
    chosen = mesh_of(mesh, faces, "render: mesh")
    picture = dict(
        width=int(size[0]), height=int(size[1]), view=view, up=up, background=background,
        from_=None if from_ is None else [float(x) for x in from_],
        orthographic=orthographic, wireframe=wireframe, flat=flat,
    )
    numbers = None if values is None else np.asarray(values, dtype=np.float32).ravel()
    return _core.render(chosen, numbers, limits, legend, picture, device)
