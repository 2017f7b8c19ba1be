"""A statistical shape model of meshes whose vertices correspond: their mean and main variations.

    lapwing batch jobs.jsonl --recipe wrap.json -o wrapped --vertices vertices.npy
    shape_model.py vertices.npy wrapped MODEL.npz [--picture MODES.png]

The recipe wraps a template onto a scan, and each line of jobs.jsonl names another scan. Jobs that
failed, and wraps that `lapwing` reports as unusable, are left out. MODEL.npz has `mean` (n, 3),
`faces`, `modes` (k, n, 3) of unit length, their standard `deviations` (k,), and the `scores`
(shapes, k) of the shapes `ids`. A shape is mean + scores @ modes.
"""

import argparse
import json
import pathlib

import matplotlib
import numpy as np

matplotlib.use("agg")
import matplotlib.pyplot as plt

import lapwing


def aligned(shapes: np.ndarray, keep_size: bool) -> np.ndarray:
    """Removes the translation, rotation and size of each shape (generalized Procrustes analysis,
    Gower 1975). The result has the mean size of the shapes."""
    shapes = shapes - shapes.mean(axis=1, keepdims=True)
    sizes = np.linalg.norm(shapes, axis=(1, 2), keepdims=True)
    if not keep_size:
        shapes = shapes * (sizes.mean() / sizes)
    mean = shapes[0]
    for _ in range(10):
        for k, shape in enumerate(shapes):
            u, _sizes, vt = np.linalg.svd(shape.T @ mean)
            flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
            shapes[k] = shape @ (u @ flip @ vt)
        mean = shapes.mean(axis=0)
    return shapes


def draw(path: str, mesh: lapwing.Mesh, model: dict) -> None:
    """Draws the two main modes at three standard deviations, the variances, and the scores."""
    mean, modes, deviations = model["mean"], model["modes"], model["deviations"]
    figure, axes = plt.subplots(2, 3, figsize=(12, 8))
    for k, row in enumerate(axes[:, :2]):
        if k >= len(modes):
            continue
        change = 3.0 * deviations[k] * modes[k]
        for axis, sign in zip(row, (-1, 1)):
            shape = mesh.with_vertices(mean + sign * change)
            distances = np.linalg.norm(change, axis=1)
            axis.imshow(lapwing.render(shape, values=distances, legend="moved", size=(400, 400)))
            axis.set_title(f"mode {k + 1}, {3 * sign:+d} standard deviations")
    for axis in axes[:, :2].flat:
        axis.axis("off")
    shares = deviations**2 / (deviations**2).sum()
    axes[0, 2].bar(np.arange(1, len(shares) + 1), 100.0 * shares)
    axes[0, 2].set(xlabel="mode", ylabel="percent of the variance")
    scores = model["scores"] / deviations
    axes[1, 2].scatter(scores[:, 0], scores[:, min(1, len(modes) - 1)])
    axes[1, 2].set(xlabel="mode 1, in standard deviations", ylabel="mode 2")
    figure.tight_layout()
    figure.savefig(path)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("vertices", help="of `lapwing batch --vertices`: .npy, (jobs, n, 3)")
    parser.add_argument("folder", help="the folder of the batch")
    parser.add_argument("model", help="write the model to this .npz file")
    parser.add_argument("--keep-size", action="store_true", help="treat size as part of the shape")
    parser.add_argument("--picture", help="write a picture to this .png file")
    arguments = parser.parse_args()

    vertices = np.load(arguments.vertices)
    folder = pathlib.Path(arguments.folder)
    # The results are in the order of the jobs. Failed jobs have no result, and their rows are NaN.
    results = [json.loads(line) for line in (folder / "results.jsonl").read_text().splitlines()]
    shapes = vertices[~np.isnan(vertices).any(axis=(1, 2))]
    usable = np.array([not result.get("wrap", {}).get("trouble") for result in results], bool)
    if usable.sum() < 3:
        parser.error(f"only {usable.sum()} of {len(vertices)} jobs have a usable result")
    mesh = lapwing.read(folder / results[0]["file"])

    shapes = aligned(shapes[usable], arguments.keep_size)
    mean = shapes.mean(axis=0)
    u, sizes, modes = np.linalg.svd((shapes - mean).reshape(len(shapes), -1), full_matrices=False)
    kept = sizes > 1e-9 * sizes[0]  # the mean takes one degree of freedom
    model = {
        "mean": mean,
        "faces": mesh.faces,
        "modes": modes[kept].reshape(-1, *mean.shape),
        "deviations": sizes[kept] / np.sqrt(len(shapes) - 1),
        "scores": u[:, kept] * sizes[kept],
        "ids": [result["id"] for result, good in zip(results, usable) if good],
    }
    np.savez(arguments.model, **model)
    shares = np.cumsum(sizes**2) / (sizes**2).sum()
    print(f"{len(shapes)} shapes of {len(vertices)} jobs; "
          f"{int(np.searchsorted(shares, 0.95)) + 1} modes have 95% of the variance")
    if arguments.picture:
        draw(arguments.picture, mesh, model)


if __name__ == "__main__":
    main()
