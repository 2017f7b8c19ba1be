"""Lapwing edits surface meshes and keeps their detail.

    import lapwing
    arm = lapwing.read("armadillo.off")
    hand = {"disk": {"center": 969, "radius": 27}}
    raised = lapwing.deform(arm, roi={"disk": {"center": 969, "radius": 72}},
                            handles=[(hand, {"translate": [-5, 13, 2]})])
    lapwing.write("raised.obj", raised)

Arrays come as the field has them: vertices (n, 3), faces (m, 3), (m, 4) or a list of polygons, of
any type of number and order in memory. Results own their memory. Nothing here opens a display, and
only `render` and `device="auto"` ask for Vulkan.
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
from ._meshes import read, shape, write
from ._operations import coat, deform, mix, run, transplant
from ._picture import render
from ._reports import (
    Check,
    Defect,
    Fixed,
    Parameterized,
    Peeled,
    Remeshed,
    check,
    fix,
    parameterize,
    peel,
    remesh,
)

__all__ = [
    "Certificate", "Check", "Defect", "Deformer", "DeviceError", "Error", "FileError", "Fixed",
    "InputError", "Many", "Mesh", "Parameterized", "Peeled", "Remeshed", "Response", "Result",
    "SolverError", "check", "coat", "deform", "fix", "mix", "parameterize", "peel", "read", "remesh", "render",
    "run", "shape", "transplant", "write",
]
