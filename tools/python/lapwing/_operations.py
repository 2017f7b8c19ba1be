"""Operations on meshes in memory. Each is a function of meshes and keys."""

from __future__ import annotations

import json
import os
from typing import Any, Dict, Mapping, Optional, Sequence, Union

from numpy.typing import ArrayLike

from . import _core
from ._arguments import (
    handles_of,
    mesh_of,
    move_of,
    plain,
    plain_of_key,
    region_of,
    step_json,
    targets_and,
)
from ._meshes import Path
from ._types import (
    Domain,
    FacesLike,
    Handle,
    Landmarks,
    LinearResponse,
    Loose,
    MeshLike,
    MeshOrVertices,
    Move,
    Operation,
    Profile,
    Progress,
    Region,
    Remesh,
    Sampling,
    Seams,
    Take,
    Weights,
)


def keys(op: Optional[Operation] = None) -> str:
    """Returns a table of the keys of an operation, or of all operations: their values, defaults and
    meaning. In recipes these are the keys of a step, in Python the parameters of the function."""
    names = _core.operations() if op is None else [op]
    return "\n".join(f"{name}\n\n{_core.key_table(name)}" for name in names)


def deform_step(count: int, name: str, keys: Mapping[str, Any]) -> str:
    """Returns the JSON of a deform step for a mesh of `count` vertices."""
    written = {
        key: plain_of_key(key, value, count, f"{name}: {key}")
        for key, value in keys.items()
        if value is not None or key in ("roi", "handles")
    }
    return step_json("deform", written)


def deform(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    roi: Region = "all",
    belt: Union[float, Region, None] = None,
    handles: Sequence[Handle] = (),
    targets: Any = None,
    landmarks: Optional[Landmarks] = None,
    stiffness: Any = None,
    mirror: Union[str, Mapping[str, Any], None] = None,
    hard: Optional[bool] = None,
    detail_length: Optional[float] = None,
    constraint_weight: Optional[float] = None,
    settle: Union[bool, Mapping[str, Any], None] = None,
    weights: Optional[Weights] = None,
    response: Optional[LinearResponse] = None,
    commit_every: Optional[float] = None,
    loose: Optional[Loose] = None,
    seams: Optional[Seams] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Bends a region of a mesh by its handles and keeps its detail.

    Parameters
    ----------
    mesh, faces
        (n, 3) vertices and (m, 3), (m, 4) or a list of faces; or one object with both, such as a
        `lapwing.Mesh`, a `trimesh.Trimesh` or an Open3D mesh.
    roi
        The part that may move; nothing outside it does. "all", vertex numbers, a mask of n values,
        or a region of a recipe: {"disk": {"center": 969, "radius": 72}}.
    belt
        The part of the ROI that stays: a number from 0 to 1 for the outer fraction of it (0.1 by
        default), or a region.
    handles
        The parts to place: pairs (region, move), or dicts with both. A move is a matrix of shape
        (4, 4) or (3, 4) that acts on column vectors in the mesh's units, or a dict with
        "translate", "rotate": {"axis", "degrees"}, "scale" (a number, or three for x, y and z) and
        "pivot". A dict may also have "orientation": "free", if the surface determines the rotation
        of the handle, and "path", the moves that the handle made before.
    targets
        Points of the surface and their prescribed positions, beside handles or instead of them:
        an array whose rows are vertex, x, y, z or px, py, pz, x, y, z for the surface point nearest
        to p; a dict from vertices to positions; or {"rows": ROWS, "hard": True}, which reaches them
        exactly. A row may end with a weight, by default 1: a larger one follows the position more
        closely, a smaller one averages over neighbouring targets and leaves out their noise.
    landmarks
        Targets as a pair (vertex numbers, positions of shape (k, 3)).
    stiffness
        The stiffness of the surface: an array of n factors from 0.01 (soft) to 100 (stiff), where
        1 means no change and inf means rigid. Connected rigid vertices, such as bones, teeth or
        armour, move as one body. Alternatively, a list of dicts {"region": REGION, "factor":
        FACTOR or "rigid"} gives the factors of regions.
    mirror
        "auto", {"plane": "x"} or {"point", "normal"}: makes the edit on both sides of that plane.
    hard
        Whether belt and handles are held exactly.
    detail_length
        Details smaller than this keep their shape; beyond it the surface bends and stretches like
        an elastic sheet. A fraction of the ROI's radius, by default 0.077.
    constraint_weight
        Holds belt and handles softly, by this weight in the least-squares system; 1 in the paper.
        Without it they reach their places.
    settle
        Whether to minimize the energy, by default True, or {"tolerance", "max_iterations"}. False
        keeps the linear response, which is accurate for small angles only.
    weights
        The edge weights of the Laplacian, "cotangent" by default or "uniform".
    response
        The linear response: "tangent" by default, or "rsi", that of the paper.
    commit_every
        Divides a larger turn into equal substeps of at most this many degrees.
    loose
        What happens to components that nothing holds: "carry" by default, which moves them with
        the nearest surface, "leave" or "refuse".
    seams
        "join" by default: boundary edges that coincide, as at texture seams, stay closed. "leave"
        lets them move apart.
    device
        "cpu" (double precision, no Vulkan needed), "auto" (a GPU, or else the CPU), or a part
        of a device's name.
    progress
        Called as progress(stage, fraction), at most every 30 ms; returning False cancels.

    Returns
    -------
    Result
        `vertices` (n, 3), `rotations` (n, 3, 3), `certificate`, `warnings`, `notes`.

    Raises
    ------
    InputError
        An argument is invalid; `vertices` of the error are the vertices concerned.
    SolverError
        The system cannot be solved.
    """
    chosen = mesh_of(mesh, faces, "deform: mesh")
    keys = dict(
        roi=roi, belt=belt, handles=handles, stiffness=stiffness, mirror=mirror, hard=hard,
        targets=targets_and(landmarks, targets, "deform"),
        detail_length=detail_length, constraint_weight=constraint_weight, settle=settle,
        weights=weights, response=response, commit_every=commit_every, loose=loose, seams=seams,
    )
    step = deform_step(chosen.vertex_count, "deform", keys)
    return _core.run_step(chosen, step, "deform", {}, device, progress)


def coat(
    target: MeshLike,
    source: Optional[MeshLike] = None,
    *,
    target_patch: Region,
    source_patch: Region = "all",
    detail_size: float,
    smooth_target: Optional[float] = None,
    amplitude: Optional[float] = None,
    scale: Optional[float] = None,
    transition: Optional[Mapping[str, Any]] = None,
    boundary_pairs: Optional[ArrayLike] = None,
    inner_pairs: Optional[ArrayLike] = None,
    domain: Optional[Domain] = None,
    sampling: Optional[Sampling] = None,
    weights: Optional[Weights] = None,
    remesh: Optional[Remesh] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Puts the fine detail of a patch of `source` on a patch of `target`.

    If the patch has to be refined, the result has new faces.

    Parameters
    ----------
    target, source
        Meshes: pairs (vertices, faces) or objects with both. The default source is the target.
    target_patch, source_patch
        Regions as in `deform`. Both must be disks; {"disk_in": REGION} finds one.
    detail_size
        A length on the source: features smaller than this are its coating.
    smooth_target
        A length on the target: its own features smaller than this are removed first; 0 by default.
    amplitude
        Factor of the coating, 1 by default; a negative value engraves it.
    scale
        Ratio of the coating's size on the target to that on the source, by default the local ratio
        of lengths.
    transition
        {"width": a, "profile": "smooth" or "linear"}: the coating fades in over this width from the
        patch's boundary, by default over the detail size on the target.
    boundary_pairs, inner_pairs
        Pairs (source vertex, target vertex) that are mapped to each other, of shape (k, 2).
    domain
        The shape that both patches are mapped to, "disk" by default or "square".
    sampling
        How the coating's Laplacians are sampled: "one_ring" by default, or "linear".
    weights
        The edge weights of the Laplacian, "cotangent" by default or "uniform".
    remesh
        "auto" by default: refines a patch that is too coarse for its coating; or "none".
    device, progress
        As in `deform`.
    """
    chosen = mesh_of(target, None, "coat: target")
    count = chosen.vertex_count
    taken = chosen if source is None else mesh_of(source, None, "coat: source")
    keys = dict(
        detail_size=detail_size, smooth_target=smooth_target, amplitude=amplitude, scale=scale,
        transition=transition, boundary_pairs=boundary_pairs, inner_pairs=inner_pairs,
        domain=domain, sampling=sampling, weights=weights, remesh=remesh,
    )
    written = {key: plain(value, count, f"coat: {key}") for key, value in keys.items()}
    written["target_patch"] = region_of(target_patch, count, "coat: target_patch")
    written["source_patch"] = region_of(source_patch, taken.vertex_count, "coat: source_patch")
    meshes = {}
    if source is not None:
        written["source"] = "source"
        meshes["source"] = taken
    return _core.run_step(chosen, step_json("coat", written), "coat", meshes, device, progress)


def mix(
    target: MeshLike,
    sources: Sequence[Mapping[str, Any]],
    *,
    target_patch: Region,
    weight: Union[ArrayLike, Mapping[str, Any]],
    take: Optional[Take] = None,
    profile: Optional[Profile] = None,
    handles: Sequence[Handle] = (),
    smooth_target: Optional[float] = None,
    transition: Optional[Mapping[str, Any]] = None,
    domain: Optional[Domain] = None,
    weights: Optional[Weights] = None,
    remesh: Optional[Remesh] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Puts a blend of two surfaces on a patch of `target`.

    Parameters
    ----------
    target
        A mesh: a pair (vertices, faces) or an object with both.
    sources
        Two dicts with "mesh" (by default the target), "patch" and "detail_size", and optionally
        "boundary_pairs", "inner_pairs", "sampling", "scale" and "amplitude", as in `coat`.
    target_patch
        The region that gets the detail; must be a disk.
    weight
        The share of the second source: an array of n values from 0 to 1,
        {"distance_to": REGION, "width": a} or {"domain_v": [a, b]}.
    take
        "coating" by default: mixes the details and adds them to the target; or "shape": mixes the
        surfaces, and replaces the target inside the patch's boundary.
    profile
        The profile of the weight, "smooth" by default or "linear".
    handles
        Handles in the patch, as in `deform`; they move in the same solve.
    smooth_target, transition, domain, weights, remesh
        As in `coat`.
    device, progress
        As in `deform`.
    """
    chosen = mesh_of(target, None, "mix: target")
    count = chosen.vertex_count
    keys = dict(
        take=take, profile=profile, smooth_target=smooth_target, transition=transition,
        domain=domain, weights=weights, remesh=remesh,
    )
    written = {key: plain(value, count, f"mix: {key}") for key, value in keys.items()}
    written["target_patch"] = region_of(target_patch, count, "mix: target_patch")
    painted = not isinstance(weight, Mapping)
    written["weight"] = plain({"field": weight} if painted else weight, count, "mix: weight")
    if handles:
        written["handles"] = handles_of(handles, count, "mix: handles")
    meshes: Dict[str, _core.Mesh] = {}
    written["sources"] = []
    for k, source in enumerate(sources):
        place = f"mix: sources[{k}]"
        if not isinstance(source, Mapping):
            raise _core.InputError(f"{place}: expected a dict, got {type(source).__name__}")
        own = {key: value for key, value in source.items() if key != "mesh"}
        taken = chosen
        if source.get("mesh") is not None:
            taken = meshes[f"source {k}"] = mesh_of(source["mesh"], None, f"{place}.mesh")
        one = plain(own, taken.vertex_count, place)
        if taken is not chosen:
            one["mesh"] = f"source {k}"
        written["sources"].append(one)
    return _core.run_step(chosen, step_json("mix", written), "mix", meshes, device, progress)


def transplant(
    host: MeshLike,
    part: Optional[MeshLike] = None,
    *,
    target_region: Region,
    part_region: Optional[Region] = None,
    loop: Optional[int] = None,
    place: Optional[Move] = None,
    snap: Optional[bool] = None,
    transition: Optional[Mapping[str, Any]] = None,
    belt: Optional[Mapping[str, Any]] = None,
    sampling: Optional[Sampling] = None,
    weights: Optional[Weights] = None,
    remesh: Optional[Remesh] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Replaces a region of `host` by `part`.

    The result has the host's vertices and faces first, in their order.

    Parameters
    ----------
    host, part
        Meshes: pairs (vertices, faces) or objects with both. The default part is the host.
    target_region
        The region of the host that is replaced; its boundary must be one loop.
    part_region
        The region to cut from the part; by default the part has a boundary loop already.
    loop
        The boundary loop of the part to join, by default the longest. Loops are numbered by their
        smallest vertices.
    place
        A matrix of shape (4, 4), a move as in `deform`, or {"auto": {...}}, the default, which fits
        the part's loop to the hole: with "rotate_degrees", and "scale" or "keep_size".
    snap
        Whether, after a move, the loop is brought onto the surface by the smallest motion.
    transition
        {"width": a, "profile": "smooth" or "linear"}: the detail blends from the host's to the
        part's within this distance of the loop, by default within half the hole's radius.
    belt
        {"padding": a, "width": b}: beyond the transition, vertices are free over `padding` and held
        over `width`.
    sampling
        How the Laplacians of the replaced region are sampled: "linear" by default, or "one_ring".
    weights
        The edge weights of the Laplacian, "cotangent" by default or "uniform".
    remesh
        "auto" by default: makes the triangles between the loops uniform; or "none".
    device, progress
        As in `deform`.
    """
    chosen = mesh_of(host, None, "transplant: host")
    count = chosen.vertex_count
    taken = chosen if part is None else mesh_of(part, None, "transplant: part")
    keys = dict(
        loop=loop, snap=snap, transition=transition, belt=belt, sampling=sampling,
        weights=weights, remesh=remesh,
    )
    written = {key: plain(value, count, f"transplant: {key}") for key, value in keys.items()}
    written["target_region"] = region_of(target_region, count, "transplant: target_region")
    if place is not None:
        written["place"] = move_of(place, count, "transplant: place")
    cut: Dict[str, Any] = {}
    if part is not None:
        cut["mesh"] = "part"
    if part_region is not None:
        cut["region"] = region_of(part_region, taken.vertex_count, "transplant: part_region")
    if not cut:
        raise _core.InputError("transplant: give a part, a part_region of the host, or both")
    written["part"] = cut
    meshes = {} if part is None else {"part": taken}
    return _core.run_step(
        chosen, step_json("transplant", written), "transplant", meshes, device, progress
    )


def run(
    recipe: Union[Path, Mapping[str, Any]],
    meshes: Optional[Mapping[str, MeshLike]] = None,
    *,
    folder: Optional[Path] = None,
    save: bool = False,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Runs a recipe.

    `recipe` is a dict, or the path of a recipe file. `meshes` replaces files by meshes in memory,
    by their names in the recipe. Other files are read from `folder`, by default the folder of the
    recipe file or the working directory. The result is written to the recipe's "save" only with
    `save=True`. `device` and `progress` are as in `deform`. `lapwing.keys()` lists the keys of the
    steps.
    """
    if isinstance(recipe, Mapping):
        text = json.dumps(plain(recipe, None, "recipe"))
        base = os.getcwd()
    else:
        path = os.fsdecode(recipe)
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise _core.FileError(f"{path}: {error.strerror}; check the path") from error
        base = os.path.dirname(os.path.abspath(path))
    named = {name: mesh_of(mesh, None, f"meshes[{name!r}]") for name, mesh in (meshes or {}).items()}
    return _core.run(text, os.fspath(folder or base), named, device, save, progress)
