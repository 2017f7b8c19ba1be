"""Lapwing edits surface meshes and keeps their detail.

    import lapwing
    arm = lapwing.read("armadillo.off")
    hand = {"disk": {"center": 969, "radius": 27}}
    raised = lapwing.deform(arm, roi={"disk": {"center": 969, "radius": 72}},
                            handles=[(hand, {"translate": [-5, 13, 2]})])
    lapwing.write("raised.obj", raised)

Vertices have shape (n, 3). Faces have shape (m, 3) or (m, 4), or are a list of polygons. Any
numeric type and memory order works. Results own their memory. No function opens a display, and only
`render` and a device other than "cpu" and "auto" need Vulkan.
"""

from ._core import (
    Certificate,
    DeviceError,
    Error,
    FileError,
    InputError,
    Mesh,
    Result,
    SolverError,
    __version__,
)
from ._deformer import Deformer, Many, Response
from ._meshes import read, shape, shape_names, write
from ._operations import coat, deform, keys, mix, run, transplant
from ._picture import render
from ._reports import (
    Check,
    Decimated,
    Defect,
    Distance,
    Filled,
    Fixed,
    GrabRegion,
    Hole,
    Parameterized,
    Peeled,
    Remeshed,
    Subdivided,
    Transferred,
    Wrapped,
    check,
    decimate,
    fill_holes,
    fix,
    grab_region,
    parameterize,
    peel,
    remesh,
    subdivide,
    transfer,
    wrap,
)

__all__ = [
    "Certificate", "Check", "Decimated", "Defect", "Deformer", "DeviceError", "Distance", "Error",
    "FileError", "Filled", "Fixed", "GrabRegion", "Hole", "InputError", "Many", "Mesh",
    "Parameterized", "Peeled", "Remeshed", "Response", "Result", "SolverError", "Subdivided",
    "Transferred", "Wrapped", "check", "coat", "decimate", "deform", "fill_holes", "fix",
    "grab_region", "keys", "mix", "parameterize", "peel", "read", "remesh", "render", "run",
    "shape", "shape_names", "subdivide", "transplant", "wrap", "write",
]
