#!/usr/bin/env python3
"""Measures `lapwing.wrap` where the correct result is known.

    wrap_study.py MESH... [--json FILE] [--scans plain,dense] [--landmarks 0,8] [--plain-loop]

Each mesh is bent by 25 degrees, stretched by (1.12, 0.95, 1.05), changed like a scan, and moved
away. The original mesh is then wrapped onto this scan. The table contains the distance of the
vertices from their true positions (mean and 95th percentile) and the mean distance from the scan,
all in percent of the scan's diagonal.

With `--plain-loop`, a loop of closest points with fixed weights around `lapwing.deform` is measured
on the same scans, as a peer. It begins with the similarity that fits the landmarks.

Needs the Python module on PYTHONPATH, numpy and scipy.
"""

import argparse
import json
import tempfile
import time
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

import lapwing

SCANS = {
    "plain": "remeshed with 0.8 of the edge length",
    "dense": "remeshed with half the edge length",
    "coarse": "remeshed with twice the edge length",
    "noisy": "remeshed, with normal noise of 0.2 edge lengths",
    "cut": "remeshed, without the 20% of the points with the largest x",
    "points": "the vertices of the dense scan, with normals and without faces",
}
EDGE_SCALES = {"plain": 0.8, "dense": 0.5, "coarse": 2.0, "noisy": 1.0, "cut": 1.0, "points": 0.5}


def diagonal(vertices):
    return np.linalg.norm(np.ptp(vertices, axis=0))


def vertex_normals(vertices, faces):
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    of_faces = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normals, faces[:, k], of_faces)
    return normals / np.maximum(np.linalg.norm(normals, axis=1), 1e-300)[:, None]


def rotation(axis, angle):
    x, y, z = np.asarray(axis) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def point_cloud(points, normals):
    names = ["x", "y", "z", "nx", "ny", "nz"]
    header = ["ply", "format ascii 1.0", f"element vertex {len(points)}"]
    header += [f"property double {name}" for name in names] + ["end_header", ""]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "points.ply"
        with path.open("w") as file:
            file.write("\n".join(header))
            np.savetxt(file, np.hstack([points, normals]))
        return lapwing.read(str(path))


def deformed(vertices, faces):
    """Returns the bent and stretched vertices."""
    by_height = np.argsort(vertices[:, 1])
    held = len(vertices) // 20
    size = diagonal(vertices)
    top = {
        "translate": (0.12 * size * np.array([1.0, 0.0, 0.3])).tolist(),
        "rotate": {"axis": [0, 0, 1], "degrees": -25},
    }
    bent = lapwing.deform(
        vertices, faces, roi="all", belt={"vertices": by_height[:held].tolist()},
        handles=[({"vertices": by_height[-held:].tolist()}, top)],
    )
    return bent.vertices * np.array([1.12, 0.95, 1.05])


class Scan:
    """A scan, the true position of each vertex of the mesh, and which of them the scan contains."""

    def __init__(self, vertices, faces, kind):
        places = deformed(vertices, faces)
        mesh = lapwing.remesh(places, faces, scale=EDGE_SCALES[kind]).mesh
        points, triangles = mesh.vertices.copy(), mesh.faces
        self.seen = np.ones(len(vertices), bool)
        if kind == "noisy":
            edge = np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1).mean()
            noise = np.random.default_rng(1).normal(size=points.shape)
            points += 0.2 * edge / np.sqrt(3.0) * noise
        if kind == "cut":
            limit = np.quantile(points[:, 0], 0.8)
            self.seen = places[:, 0] <= limit
            kept = points[:, 0] <= limit
            numbers = np.cumsum(kept) - 1
            triangles = numbers[triangles[kept[triangles].all(axis=1)]]
            points = points[kept]
        away = 1.7 * rotation([1, 2, 3], 1.0)
        shift = diagonal(vertices) * np.array([2.0, 1.0, -1.0])
        self.points, self.triangles = points @ away.T + shift, triangles
        self.places = places @ away.T + shift
        self.mesh = lapwing.Mesh(self.points, self.triangles)
        if kind == "points":
            self.mesh = point_cloud(self.points, vertex_normals(self.points, self.triangles))

    def errors(self, vertices):
        size = diagonal(self.points)
        off = np.linalg.norm(vertices - self.places, axis=1)[self.seen] / size * 100
        return {"mean": off.mean(), "percentile_95": np.quantile(off, 0.95)}


def spread_vertices(vertices, count):
    """Returns farthest-point samples."""
    chosen = [int(np.argmax(vertices[:, 1]))]
    distances = np.full(len(vertices), np.inf)
    while len(chosen) < count:
        distances = np.minimum(distances, np.linalg.norm(vertices - vertices[chosen[-1]], axis=1))
        chosen.append(int(np.argmax(distances)))
    return chosen[:count]


def similarity(source, goal):
    """Returns the best-fitting similarity transformation (Umeyama 1991), as a function."""
    p, q = source - source.mean(axis=0), goal - goal.mean(axis=0)
    u, s, vt = np.linalg.svd(q.T @ p)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    linear = np.trace(np.diag(s) @ flip) / (p**2).sum() * u @ flip @ vt
    return lambda points: (points - source.mean(axis=0)) @ linear.T + goal.mean(axis=0)


def plain_loop(vertices, faces, scan, landmarks):
    """Returns the vertices after 16 deformations toward the closest points."""
    size = diagonal(scan.points)
    corners = scan.points[scan.triangles]
    samples = np.concatenate([corners.mean(axis=1), scan.points])
    normals = vertex_normals(scan.points, scan.triangles)
    of_faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    of_faces /= np.maximum(np.linalg.norm(of_faces, axis=1), 1e-300)[:, None]
    normals = np.concatenate([of_faces, normals])
    tree = cKDTree(samples)
    rest = similarity(vertices[landmarks], scan.places[landmarks])(vertices)
    now = rest
    for weight in [0.003] * 4 + [0.01] * 4 + [0.03] * 3 + [0.1] * 3 + [0.3, 1.0]:
        distances, found = tree.query(now, k=8)
        facing = np.einsum("vkd,vd->vk", normals[found], vertex_normals(now, faces)) > 0.5
        first = np.argmax(facing, axis=1)
        rows = np.arange(len(now))
        near = distances[rows, first]
        used = facing.any(axis=1) & (near < max(3 * np.median(near), 0.02 * size))
        used[landmarks] = False
        goals = samples[found[rows, first]]
        targets = [[int(v), *goals[v], weight] for v in np.flatnonzero(used)]
        targets += [[int(v), *scan.places[v], 10.0] for v in landmarks]
        now = lapwing.deform(rest, faces, roi="all", belt={"vertices": []}, targets=targets).vertices
    return now


def measure(path, kinds, counts, with_plain_loop):
    mesh = lapwing.read(str(path))
    vertices, faces = mesh.vertices, mesh.faces
    for kind in kinds:
        scan = Scan(vertices, faces, kind)
        for count in counts:
            landmarks = spread_vertices(vertices, count)
            pairs = [[v, *scan.places[v]] for v in landmarks]
            row = {"mesh": path.stem, "vertices": len(vertices), "scan": kind,
                   "scan_vertices": len(scan.points), "landmarks": count}
            begin = time.perf_counter()
            try:
                result = lapwing.wrap(mesh, scan.mesh, landmarks=pairs)
                row["seconds"] = time.perf_counter() - begin
                row |= scan.errors(result.mesh.vertices)
                row["to_scan"] = result.to_scan.mean / diagonal(scan.points) * 100
                row["coverage"] = result.coverage
                row["flipped_triangles"] = result.flipped_triangles
            except lapwing.LapwingError as error:
                row["error"] = str(error)
            if with_plain_loop and count >= 3 and kind != "points":
                row["plain_loop"] = scan.errors(plain_loop(vertices, faces, scan, landmarks))
            yield row


def text_of(row):
    text = (f"{row['mesh']:<20}{row['vertices']:>7,} {row['scan']:<7}{row['scan_vertices']:>8,}"
            f"{row['landmarks']:>4}  ")
    if "error" in row:
        return text + row["error"]
    text += (f"{row['mean']:6.2f}{row['percentile_95']:6.2f}{row['to_scan']:7.3f}"
             f"{row['coverage'] * 100:6.1f}%{row['flipped_triangles']:5}{row['seconds']:7.1f}")
    if "plain_loop" in row:
        text += f"   {row['plain_loop']['mean']:6.2f}{row['plain_loop']['percentile_95']:6.2f}"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("meshes", nargs="+", type=Path)
    parser.add_argument("--json", type=Path, help="write the rows to this file")
    parser.add_argument("--scans", default=",".join(SCANS), help=", ".join(SCANS))
    parser.add_argument("--landmarks", default="0,4,8,20", help="counts")
    parser.add_argument("--plain-loop", action="store_true", help="measure the plain loop, too")
    arguments = parser.parse_args()
    print("mesh               vertices scan  vertices  lm    mean   95% to scan cover flips"
          "      s   plain loop: mean, 95%")
    rows = []
    for path in arguments.meshes:
        counts = [int(count) for count in arguments.landmarks.split(",")]
        for row in measure(path, arguments.scans.split(","), counts, arguments.plain_loop):
            rows.append(row)
            print(text_of(row), flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
