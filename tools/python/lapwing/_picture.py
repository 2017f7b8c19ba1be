"""Pictures without a display."""

from __future__ import annotations

import os
from typing import Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arguments import mesh_of
from ._meshes import Path
from ._types import Array, Background, FacesLike, MeshOrVertices, UpAxis, View


def render(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    values: Optional[ArrayLike] = None,
    limits: Optional[Tuple[float, float]] = None,
    legend: str = "",
    size: Tuple[int, int] = (640, 480),
    view: View = "three-quarter",
    from_: Optional[Sequence[float]] = None,
    up: UpAxis = "y",
    background: Background = "white",
    orthographic: bool = False,
    wireframe: bool = False,
    flat: bool = False,
    path: Optional[Path] = None,
    device: str = "auto",
) -> Array:
    """Returns a picture of a mesh, (height, width, 4) uint8, for `matplotlib.pyplot.imshow`.

    `values`, one per vertex, colour the mesh, with a legend over `limits`, by default from the
    smallest to the largest value; NaN has no colour. `view` is "three-quarter", "front", "back",
    "left", "right", "top" or "bottom"; `from_`, a direction to the eye, replaces it. `up` is the
    axis that points up, "y" or "z". `size` is the width and the height in pixels, `background`
    "white", "gradient" or "transparent". `orthographic` draws without perspective, `wireframe` adds
    the edges, and `flat` shades each face by its own normal. `path` names a PNG file to write, too.

    Needs Vulkan; Mesa's software device is enough. DeviceError says what to install. Notebooks show
    a `Mesh` and a `Result` in the default view.
    """
    chosen = mesh_of(mesh, faces, "render: mesh")
    picture = dict(
        width=int(size[0]), height=int(size[1]), view=view, up=up, background=background,
        from_=None if from_ is None else [float(x) for x in from_],
        orthographic=orthographic, wireframe=wireframe, flat=flat,
    )
    numbers = None if values is None else np.asarray(values, dtype=np.float32).ravel()
    return _core.render(chosen, numbers, limits, legend, picture, device,
                        "" if path is None else os.fspath(path))
