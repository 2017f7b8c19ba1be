"""Checks, repairs and other operations without an edit."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Literal, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from ._arguments import (
    mesh_of,
    region_of,
    stiffness_of,
    vertices_of,
    wrap_landmarks_of,
)
from ._types import (
    Array,
    Domain,
    FacesLike,
    FacesOf,
    MeshOrVertices,
    Progress,
    Region,
    Weights,
)


@dataclass(frozen=True)
class Defect:
    """One kind of defect of a mesh, and its places."""

    kind: str  #: identifier, such as "unwelded_seam"
    name: str  #: words for users, such as "unwelded seam edges"
    count: int
    severity: str  #: "info", "warning" or "error" (a region cannot contain this place)
    meaning: str
    next_step: str
    element: str  #: type of the elements in `first`: "vertex", "face", "edge", "component", "rim", "mesh"
    first: Array  #: the first elements with this defect, ascending; an edge is two vertices
    fixable: bool  #: whether `fix` repairs all of them


@dataclass(frozen=True)
class Hole:
    """A boundary loop of a mesh."""

    rim: Array  #: vertices in order, in the orientation of a face that closes the hole
    perimeter: float
    is_border: bool  #: whether it is the border of an open sheet, which `fill_holes` omits
    trouble: str  #: why it cannot be filled; empty if it can


@dataclass(frozen=True)
class Check:
    """Result of `check`."""

    defects: List[Defect]
    holes: List[Hole]  #: all boundary loops, those with the most vertices first
    statistics: Dict[str, Any]
    has_problems: bool
    is_fixable: bool


@dataclass(frozen=True)
class _Made:
    mesh: _core.Mesh

    @property
    def vertices(self) -> Array:
        return self.mesh.vertices

    @property
    def faces(self) -> FacesOf:
        return self.mesh.faces

    def __iter__(self) -> Iterator[Array]:
        """V, F = result"""
        return iter(self.mesh)


@dataclass(frozen=True)
class Fixed(_Made):
    """Result of `fix`: `mesh`, `vertices`, `faces`."""

    repairs: Dict[str, int]  #: number of repairs of each kind
    vertex_sources: Array  #: for each vertex, its number in the damaged mesh


@dataclass(frozen=True)
class Filled(_Made):
    """Result of `fill_holes`: `mesh`, `vertices`, `faces`."""

    holes: int  #: number of filled holes
    new_vertices: int  #: number of new vertices, which come last
    new_faces: int  #: number of new triangles, which come last
    warnings: List[str]


@dataclass(frozen=True)
class Decimated(_Made):
    """Result of `decimate`: `mesh`, `vertices`, `faces`."""

    kept: Array  #: for each vertex, its number in the given mesh


@dataclass(frozen=True)
class Subdivided(_Made):
    """Result of `subdivide`: `mesh`, `vertices`, `faces`. The given vertices come first."""


@dataclass(frozen=True)
class Peeled(_Made):
    """Result of `peel`: the smooth `mesh`, its `vertices` and `faces`."""

    coating: Array  #: (n, 3), vectors from the smooth surface to the original surface
    moved: Array  #: vertices that may have moved
    mean_coating: float
    largest_coating: float
    warnings: List[str]


@dataclass(frozen=True)
class Remeshed(_Made):
    """Result of `remesh`: `mesh`, `vertices`, `faces`."""

    kept: Array  #: for each vertex, its number in the original mesh, or 2**32 - 1 for a new vertex
    region: Array  #: vertices of the remeshed region
    mean_edge: float
    smallest_angle_degrees: float
    warnings: List[str]


@dataclass(frozen=True)
class Parameterized(_Made):
    """Result of `parameterize`: the given `mesh` with texture coordinates, and the map."""

    #: (p, 2), points of the disk or square: the patch's vertices, then the midpoints of split edges
    points: Array
    patch_vertices: Array  #: mesh vertex of each point, without the midpoints
    patch_faces: Array  #: (t, 3), indices into `points`
    pins: Array
    flipped: Array  #: flipped triangles of the patch
    stretch: float  #: distortion of lengths; 1 if the map preserves lengths
    shear: float  #: distortion of angles; 1 if the map preserves angles
    warnings: List[str]


@dataclass(frozen=True)
class GrabRegion:
    """Result of `grab_region`."""

    vertices: Array  #: vertices that move, ascending: an ROI for `deform`
    radius: float  #: geodesic radius of the disk around the grabbed vertex
    is_limb: bool  #: whether the shape of a limb, rather than the brush, bounds the region


@dataclass(frozen=True)
class Distance:
    """Distances from the vertices of one surface to another, in the unit of the scan."""

    mean: float
    percentile_95: float
    max: float


@dataclass(frozen=True)
class Wrapped:
    """Result of `wrap`."""

    mesh: _core.Mesh  #: the template with its vertices on the scan
    to_scan: Distance  #: from the vertices of the result
    to_template: Distance  #: from the vertices of the scan
    coverage: float  #: fraction of the template's area that has a counterpart on the scan
    landmark_error: float  #: the largest
    scale: float  #: of the similarity that aligned the template
    flipped_triangles: int
    edge_stretch: float  #: root mean square of length' / length - 1 over the edges
    steps: int  #: number of minimizations
    trouble: str  #: why the result is not usable, and what to try; empty if it is usable
    notes: List[str]  #: landmarks of files that have no counterpart


@dataclass(frozen=True)
class Transferred:
    """Result of `transfer`. The lists have one entry for each pose."""

    vertices: Array  #: of the target: (n, 3), or (k, n, 3) for k poses
    unmatched_area: float  #: share of the target's area without a counterpart
    largest_rotation_degrees: List[float]
    edge_stretch: List[float]  #: root mean square of length' / length - 1 over the edges
    flipped_triangles: List[int]
    inside_out_share: List[float]  #: share of the area that is inside out
    warnings: List[str]  #: why the results may be wrong
    notes: List[str]  #: landmarks of files that have no counterpart


def _region_json(region: Any, mesh: _core.Mesh, where: str) -> str:
    return json.dumps(region_of(region, mesh.vertex_count, where))


def check(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    self_intersections: bool = False,
    most_listed: int = 8,
) -> Check:
    """Returns the defects of a mesh, and what they mean for an edit. Checking for
    `self_intersections` takes several times as long as everything else. Each defect lists the
    first `most_listed` of its places."""
    found = _core.check(mesh_of(mesh, faces, "check: mesh"), self_intersections, most_listed)
    found["holes"] = [Hole(**hole) for hole in found["holes"]]
    found["defects"] = [Defect(**defect) for defect in found["defects"]]
    return Check(**found)


def fix(mesh: MeshOrVertices, faces: Optional[FacesLike] = None) -> Fixed:
    """Repairs defects that have one sensible repair. Positions do not change."""
    return Fixed(**_core.fix(mesh_of(mesh, faces, "fix: mesh")))


def fill_holes(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    region: Region = "all",
    shape: Literal["flat", "smooth"] = "smooth",
    largest: int = 0,
    borders: bool = False,
    progress: Progress = None,
) -> Filled:
    """Fills the holes of a mesh. If `shape` is "flat", a fill consists of triangles between the
    vertices of the rim. If it is "smooth", the triangles have the size of those at the rim and
    continue the tangent planes of the surface. Holes without a rim vertex in `region` stay open.
    If `largest` is not 0, holes with more rim vertices than this also stay open. The border of an
    open sheet is filled only if `borders` is true. The new triangles have no texture coordinates.
    `progress` is as in `deform`."""
    chosen = mesh_of(mesh, faces, "fill_holes: mesh")
    where = _region_json(region, chosen, "fill_holes: region")
    return Filled(**_core.fill_holes(chosen, where, shape, largest, borders, progress))


def decimate(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    share: float = 0.5,
    progress: Progress = None,
) -> Decimated:
    """Triangulates the mesh and keeps about the fraction `share` of its vertices, those that
    matter most for the shape. Seams of texture coordinates and borders of materials stay. Stored
    normals are dropped. `progress` is as in `deform`."""
    return Decimated(**_core.decimate(mesh_of(mesh, faces, "decimate: mesh"), share, progress))


def subdivide(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    times: int = 1,
    smooth: bool = False,
    progress: Progress = None,
) -> Subdivided:
    """Triangulates the mesh and cuts each triangle into four, `times` times. If `smooth` is true,
    Loop's scheme smooths the shape; otherwise the shape does not change. Stored normals are
    dropped. `progress` is as in `deform`."""
    chosen = mesh_of(mesh, faces, "subdivide: mesh")
    return Subdivided(**_core.subdivide(chosen, times, smooth, progress))


def peel(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    detail_size: float,
    region: Region = "all",
    weights: Weights = "cotangent",
) -> Peeled:
    """Removes the fine detail of a region: features smaller than the length `detail_size`. The
    boundary of the region stays. `weights` are the edge weights of the Laplacian."""
    chosen = mesh_of(mesh, faces, "peel: mesh")
    return Peeled(
        **_core.peel(chosen, _region_json(region, chosen, "peel: region"), detail_size, weights)
    )


def remesh(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    region: Region = "all",
    length: Optional[float] = None,
    scale: float = 1.0,
    iterations: int = 5,
    feature_degrees: float = 45.0,
    progress: Progress = None,
) -> Remeshed:
    """Remeshes a region with nearly equilateral triangles of one size on the same surface. Edges
    have `length`, or `scale` times the region's mean edge length. Edges between faces that meet at
    `feature_degrees` or more are kept. `iterations` is the number of passes over the region.
    `progress` is as in `deform`."""
    chosen = mesh_of(mesh, faces, "remesh: mesh")
    return Remeshed(
        **_core.remesh(
            chosen,
            _region_json(region, chosen, "remesh: region"),
            length,
            scale,
            iterations,
            feature_degrees,
            progress,
        )
    )


def parameterize(
    mesh: MeshOrVertices,
    faces: Optional[FacesLike] = None,
    *,
    region: Region = "all",
    domain: Domain = "disk",
    pins: Sequence[int] = (),
) -> Parameterized:
    """Maps a region that is a disk to a `domain`, the unit "disk" or "square", by mean value
    coordinates. `pins` are the boundary vertex for the disk's rightmost point, or four for the
    square's corners, counterclockwise from the lower left."""
    chosen = mesh_of(mesh, faces, "parameterize: mesh")
    return Parameterized(
        **_core.parameterize(
            chosen,
            _region_json(region, chosen, "parameterize: region"),
            domain,
            vertices_of(pins, "parameterize: pins"),
        )
    )


def wrap(
    template: MeshOrVertices,
    scan: MeshOrVertices,
    landmarks: Any = (),
    *,
    faces: Optional[FacesLike] = None,
    scan_faces: Optional[FacesLike] = None,
    aligned: bool = False,
    stiffness: Any = None,
    mirror: Union[str, Mapping[str, Any], None] = None,
    hard: bool = False,
    detail: bool = False,
    progress: Optional[Progress] = None,
) -> Wrapped:
    """Deforms a template so that it covers a scan, which has other vertices and triangles.

    The result keeps the triangles of the template. `landmarks` is a dict from vertices of the
    template to positions on the scan or vertices of the scan, or a list of rows (`lapwing.keys`),
    or the path of a file of landmarks, or a pair of paths: points of the template and of the scan,
    as 3D Slicer saves them. Three landmarks align the template. Without them, the template is
    aligned by comparing the shapes of both surfaces, which can fail for symmetric surfaces. If
    `aligned` is true, the template is already in place and is only deformed. `stiffness` has the
    same meaning as for `deform`. `mirror` is the plane in which the template is symmetric, as for
    `deform`; the result is then symmetric, too. If `hard` is true, landmarks are reached exactly.
    If `detail` is true, vertices with a counterpart end exactly on the scan. The faces of both
    meshes must be oriented outward. The scan may be a point cloud with normals and without faces,
    as `read` returns it.

        wrapped = lapwing.wrap(template, scan, {12: [0, 1, 0], 801: [4, 0, 0], 77: [0, 0, 2]})
        assert not wrapped.trouble, wrapped.trouble
    """
    chosen = mesh_of(template, faces, "wrap: template")
    covered = mesh_of(scan, scan_faces, "wrap: scan")
    rows = wrap_landmarks_of(landmarks, chosen.vertex_count, "wrap: landmarks")
    step: Dict[str, Any] = {"op": "wrap", "scan": "scan", "landmarks": rows, "aligned": aligned}
    step.update(hard=hard, detail=detail)
    if stiffness is not None:
        step["stiffness"] = stiffness_of(stiffness, chosen.vertex_count, "wrap: stiffness")
    if mirror is not None:
        step["mirror"] = mirror
    found = _core.wrap(chosen, covered, json.dumps(step), progress)
    for name in ("to_scan", "to_template"):
        found[name] = Distance(**found[name])
    return Wrapped(**found)


def transfer(
    source: MeshOrVertices,
    poses: Any,
    target: MeshOrVertices,
    landmarks: Any = (),
    *,
    faces: Optional[FacesLike] = None,
    target_faces: Optional[FacesLike] = None,
    correspondence: Optional[Any] = None,
    held: Any = None,
    aligned: bool = False,
    progress: Optional[Progress] = None,
) -> Transferred:
    """Transfers poses of a source mesh to a target mesh.

    `source` is at rest, and `poses` contains its vertices in one pose, (n, 3), or in many, (k, n,
    3). If both meshes have the same faces, vertices with the same number correspond. Otherwise the
    target is wrapped onto the source: `landmarks` and `aligned` have the same meaning as for
    `wrap`, with the target as the template. `correspondence` replaces this by
    known positions of the target's vertices on the source, such as those of a wrapped mesh. The
    vertices `held`, a region of the target, do not move.

        wrapped = lapwing.wrap(camel, horse, landmarks)
        walk = lapwing.transfer(horse, steps, camel, correspondence=wrapped.mesh.vertices)
    """
    moved = mesh_of(source, faces, "transfer: source")
    onto = mesh_of(target, target_faces, "transfer: target")
    try:
        given = np.asarray(poses, np.float64)
    except (TypeError, ValueError) as error:
        raise _core.InputError(f"transfer: poses: expected shape (k, n, 3) or (n, 3): {error}")
    is_one = given.ndim == 2
    found = _core.transfer(
        moved,
        [given] if is_one else list(given),
        onto,
        json.dumps(wrap_landmarks_of(landmarks, onto.vertex_count, "transfer: landmarks")),
        correspondence,
        None if held is None else _region_json(held, onto, "transfer: held"),
        aligned,
        progress,
    )
    vertices = found.pop("vertices")
    shape = (-1, onto.vertex_count, 3)
    return Transferred(
        vertices=vertices[0] if is_one else np.array(vertices).reshape(shape), **found
    )


def grab_region(
    mesh: MeshOrVertices,
    vertex: int,
    radius: float,
    *,
    faces: Optional[FacesLike] = None,
    factor: float = 1.0,
) -> GrabRegion:
    """Chooses the region that moves when the user pulls on the surface at one vertex.

    `radius` is the length of the brush along the surface. On a limb, such as an arm, the region
    ends where the limb joins the body. Elsewhere it is a disk of three brush radii. Parts that the
    region cuts off, such as the tip of the limb, belong to it. `factor` scales the disk, which
    never covers more than half of its component.

        grab = lapwing.grab_region(arm, 969, 12.0)
        hand = {"disk": {"center": 969, "radius": 12.0}}
        raised = lapwing.deform(arm, roi=grab.vertices, handles=[(hand, {"translate": [0, 9, 0]})])
    """
    chosen = mesh_of(mesh, faces, "grab_region: mesh")
    (center,) = vertices_of([vertex], "grab_region: vertex")
    return GrabRegion(**_core.grab_region(chosen, center, radius, factor))
