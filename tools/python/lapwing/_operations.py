"""Operations on meshes in memory. Each is a function of meshes and keys."""

from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, Mapping, Optional, Sequence

from . import _core
from ._arguments import (
    belt_of,
    handles_of,
    mesh_of,
    move_of,
    plain,
    region_of,
    step_json,
    targets_of,
)

Progress = Optional[Callable[[str, float], Optional[bool]]]


def deform_step(count: int, name: str, keys: Mapping[str, Any]) -> str:
    """Returns the JSON of a deform step for a mesh of `count` vertices."""
    written = {key: plain(value, count, f"{name}: {key}") for key, value in keys.items()
               if key not in ("roi", "belt", "handles", "targets")}
    written["roi"] = region_of(keys["roi"], count, f"{name}: roi")
    if keys["belt"] is not None:
        written["belt"] = belt_of(keys["belt"], count, f"{name}: belt")
    written["handles"] = handles_of(keys["handles"], count, f"{name}: handles")
    if keys["targets"] is not None:
        written["targets"] = targets_of(keys["targets"], count, f"{name}: targets")
    return step_json("deform", written)


def deform(
    mesh: Any,
    faces: Any = None,
    *,
    roi: Any = "all",
    belt: Any = None,
    handles: Sequence[Any] = (),
    targets: Any = None,
    mirror: Any = None,
    hard: Optional[bool] = None,
    detail_length: Optional[float] = None,
    constraint_weight: Optional[float] = None,
    settle: Any = None,
    weights: Optional[str] = None,
    response: Optional[str] = None,
    commit_every: Optional[float] = None,
    loose: Optional[str] = None,
    seams: Optional[str] = None,
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
        Landmarks, beside handles or instead of them: an array whose rows are vertex, x, y, z (a
        weight may follow) or px, py, pz, x, y, z; a dict from vertices to positions; or
        {"rows": ROWS, "hard": True}, which reaches them exactly.
    mirror
        "auto", {"plane": "x"} or {"point", "normal"}: makes the edit on both sides of that plane.
    hard, detail_length, constraint_weight, settle, weights, response, commit_every, loose, seams
        As in recipes (`lapwing keys deform`).
    device
        "cpu" (double precision, no Vulkan needed), "auto" or a part of a device's name.
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
        roi=roi, belt=belt, handles=handles, targets=targets, mirror=mirror, hard=hard,
        detail_length=detail_length, constraint_weight=constraint_weight, settle=settle,
        weights=weights, response=response, commit_every=commit_every, loose=loose, seams=seams,
    )
    step = deform_step(chosen.vertex_count, "deform", keys)
    return _core.run_step(chosen, step, "deform", {}, device, progress)


def coat(
    target: Any,
    source: Any = None,
    *,
    target_patch: Any,
    source_patch: Any = "all",
    detail_size: float,
    smooth_target: Optional[float] = None,
    amplitude: Optional[float] = None,
    scale: Optional[float] = None,
    transition: Any = None,
    boundary_pairs: Any = None,
    inner_pairs: Any = None,
    domain: Optional[str] = None,
    sampling: Optional[str] = None,
    weights: Optional[str] = None,
    remesh: Optional[str] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Puts the fine detail of a patch of `source` on a patch of `target`.

    Meshes are pairs (vertices, faces) or objects with both; the default `source` is the target
    itself. Patches are regions as in `deform`, and must be disks: {"disk_in": REGION} finds one.
    `detail_size` is a length on the source: smaller features are its coating. The others are keys
    of recipes (`lapwing keys coat`). If the patch has to be refined, the result has new faces.
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
    target: Any,
    sources: Sequence[Mapping[str, Any]],
    *,
    target_patch: Any,
    weight: Any,
    take: Optional[str] = None,
    profile: Optional[str] = None,
    handles: Sequence[Any] = (),
    smooth_target: Optional[float] = None,
    transition: Any = None,
    domain: Optional[str] = None,
    weights: Optional[str] = None,
    remesh: Optional[str] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Puts a blend of two surfaces on a patch of `target`.

    `sources` are two dicts with "mesh" (by default the target itself), "patch", "detail_size" and
    the other keys of a recipe's sources. `weight` is the share of the second source: an array of n
    values from 0 to 1, {"distance_to": REGION, "width": a} or {"domain_v": [a, b]}. The others are
    keys of recipes (`lapwing keys mix`).
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
    host: Any,
    part: Any = None,
    *,
    target_region: Any,
    part_region: Any = None,
    loop: Optional[int] = None,
    place: Any = None,
    snap: Optional[bool] = None,
    transition: Any = None,
    belt: Any = None,
    sampling: Optional[str] = None,
    weights: Optional[str] = None,
    remesh: Optional[str] = None,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Replaces a region of `host` by `part`.

    Meshes are pairs (vertices, faces) or objects with both. `part_region` is the region to cut from
    `part`, by default from the host itself. `place` is a matrix of shape (4, 4), a move as in
    `deform`, or {"auto": {...}}, the default, which fits the part's loop to the hole. The others
    are keys of recipes (`lapwing keys transplant`). The result has the host's vertices and faces
    first, in their order.
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
    recipe: Any,
    meshes: Optional[Mapping[str, Any]] = None,
    *,
    folder: Any = None,
    save: bool = False,
    device: str = "cpu",
    progress: Progress = None,
) -> _core.Result:
    """Runs a recipe.

    `recipe` is a dict, or the path of a recipe file. `meshes` replaces files by meshes in memory,
    by their names in the recipe. Other files are read from `folder`, by default the folder of the
    recipe file or the working directory. The result is written to the recipe's "save" only with
    `save=True`.
    """
    if isinstance(recipe, Mapping):
        text = json.dumps(plain(recipe, None, "recipe"))
        base = os.getcwd()
    else:
        path = os.fspath(recipe)
        try:
            with open(path, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise _core.FileError(f"{path}: {error.strerror}; check the path") from error
        base = os.path.dirname(os.path.abspath(path))
    named = {name: mesh_of(mesh, None, f"meshes[{name!r}]") for name, mesh in (meshes or {}).items()}
    return _core.run(text, os.fspath(folder or base), named, device, save, progress)
