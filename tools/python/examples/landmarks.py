"""Fits a template to landmarks: first as a whole (rotation, size and place), then its surface.

    landmarks.py TEMPLATE LANDMARKS.csv FITTED

A row of LANDMARKS.csv is a vertex of the template and its position x, y, z, as an anatomist marks
it on a scan. The fitted mesh keeps the template's vertices and faces, so that all fitted meshes
correspond vertex by vertex.
"""

import argparse

import numpy as np

import lapwing


def best_similarity(points: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Returns the rotation, scale and translation, as a matrix of shape (4, 4), that bring `points`
    nearest to `places` in the least-squares sense (Umeyama 1991)."""
    p, q = points - points.mean(0), places - places.mean(0)
    u, sizes, vt = np.linalg.svd(q.T @ p)
    keep = np.array([1.0, 1.0, np.sign(np.linalg.det(u @ vt))])
    scale = (sizes * keep).sum() / (p**2).sum()
    matrix = np.eye(4)
    matrix[:3, :3] = scale * (u * keep) @ vt
    matrix[:3, 3] = places.mean(0) - matrix[:3, :3] @ points.mean(0)
    return matrix


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("template", help="OBJ, OFF, PLY, STL or glTF")
    parser.add_argument("landmarks", help="CSV: vertex, x, y, z")
    parser.add_argument("fitted", help="where the result goes")
    parser.add_argument("--hard", action="store_true", help="reach every landmark exactly")
    arguments = parser.parse_args()

    template = lapwing.read(arguments.template)
    rows = np.loadtxt(arguments.landmarks, delimiter=",", ndmin=2)
    vertices, places = rows[:, 0].astype(int), rows[:, 1:4]

    matrix = best_similarity(template.vertices[vertices], places)
    placed = template.with_vertices(template.vertices @ matrix[:3, :3].T + matrix[:3, 3])
    fitted = lapwing.deform(
        placed, belt=0.0, targets={"rows": rows[:, :4], "hard": arguments.hard}
    )

    def distance(mesh) -> float:
        return float(np.sqrt(((mesh.vertices[vertices] - places) ** 2).sum(1).mean()))

    print(f"landmarks off by {distance(placed):.4g} as a whole, {distance(fitted):.4g} when fitted")
    print(f"detail error {fitted.certificate.detail_error:.3f}, "
          f"edge stretch {fitted.certificate.edge_stretch:.3f}")
    for note in fitted.warnings + lapwing.write(arguments.fitted, fitted):
        print("note:", note)


if __name__ == "__main__":
    main()
