"""A data set of random variants of one mesh, as learning on meshes needs it.

    data_set.py MESH OUT.npz --center VERTEX --radius R [--count 1000] [--seed 0]

The region is the geodesic disk of radius R around VERTEX. Its inner third is the handle, which each
variant translates and rotates at random. OUT.npz has `vertices` (n, 3), `faces`, `motions` (count,
1, 4, 4), `displacements` (count, n, 3) as float32, and per variant `detail_error` and `settled`.
"""

import argparse
import time

import numpy as np

import lapwing


def random_motions(rng: np.random.Generator, center: np.ndarray, size: float, count: int):
    """Returns random rotations of up to 60 degrees about axes through `center`, with translations
    of up to `size`."""
    axes = rng.normal(size=(count, 3))
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.radians(rng.uniform(0.0, 60.0, size=count))
    cross = np.zeros((count, 3, 3))
    cross[:, [2, 0, 1], [1, 2, 0]] = axes
    cross[:, [1, 2, 0], [2, 0, 1]] = -axes
    motions = np.tile(np.eye(4), (count, 1, 1, 1))
    turns = np.eye(3) + np.sin(angles)[:, None, None] * cross
    turns += (1.0 - np.cos(angles))[:, None, None] * (cross @ cross)
    motions[:, 0, :3, :3] = turns
    motions[:, 0, :3, 3] = center - turns @ center + rng.uniform(-size, size, size=(count, 3))
    return motions


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("mesh", help="OBJ, OFF, PLY, STL or glTF")
    parser.add_argument("out", help="where the data set goes, .npz")
    parser.add_argument("--center", type=int, required=True, help="a vertex")
    parser.add_argument("--radius", type=float, required=True)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()

    mesh = lapwing.read(arguments.mesh)

    def disk(radius):
        return {"disk": {"center": arguments.center, "radius": radius}}

    start = time.perf_counter()
    deformer = lapwing.Deformer(
        mesh, roi=disk(arguments.radius), handles=[disk(arguments.radius / 3.0)]
    )
    prepared = time.perf_counter()
    rest = mesh.vertices
    motions = random_motions(
        np.random.default_rng(arguments.seed),
        rest[deformer.handles[0]].mean(0),
        arguments.radius / 4.0,
        arguments.count,
    )
    variants = deformer.solve_many(motions, dtype=np.float32)
    solved = time.perf_counter()
    np.savez(
        arguments.out,
        vertices=rest,
        faces=mesh.faces,
        motions=motions,
        displacements=variants.vertices - rest.astype(np.float32),
        detail_error=[c.detail_error for c in variants.certificates],
        settled=[c.settled for c in variants.certificates],
    )
    print(f"{deformer}: prepared in {prepared - start:.2f} s, "
          f"{arguments.count / (solved - prepared):.1f} variants a second")


if __name__ == "__main__":
    main()
