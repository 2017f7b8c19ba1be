"""Puts the fine detail of one mesh on another, and shows both beside the result.

    coat.py SOURCE TARGET COATED [--picture PNG]

Both patches are the largest disks around a given vertex, by default the one farthest from the
centre of its mesh.
"""

import argparse

import numpy as np

import lapwing


def patch_around(mesh: lapwing.Mesh, vertex: int, share: float) -> dict:
    """Returns the largest disk around `vertex` within `share` of the mesh's size."""
    size = np.linalg.norm(np.ptp(mesh.vertices, axis=0))
    return {"disk_in": {"disk": {"center": vertex, "radius": share * size}}}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source")
    parser.add_argument("target")
    parser.add_argument("coated", help="where the result goes")
    parser.add_argument("--source-vertex", type=int)
    parser.add_argument("--target-vertex", type=int)
    parser.add_argument("--radius", type=float, default=0.12, help="in sizes of each mesh")
    parser.add_argument("--detail", type=float, default=0.03, help="in sizes of the source")
    parser.add_argument("--picture", help="PNG of source, target and result")
    arguments = parser.parse_args()

    def center(mesh, vertex):
        far = np.linalg.norm(mesh.vertices - mesh.vertices.mean(0), axis=1).argmax()
        return int(far) if vertex is None else vertex

    source, target = lapwing.read(arguments.source), lapwing.read(arguments.target)
    coated = lapwing.coat(
        target,
        source,
        source_patch=patch_around(
            source, center(source, arguments.source_vertex), arguments.radius
        ),
        target_patch=patch_around(
            target, center(target, arguments.target_vertex), arguments.radius
        ),
        detail_size=arguments.detail * np.linalg.norm(np.ptp(source.vertices, axis=0)),
    )
    for note in coated.notes + coated.warnings + lapwing.write(arguments.coated, coated):
        print("note:", note)
    print(f"{len(coated.roi)} vertices coated")
    if arguments.picture:
        import matplotlib.image

        pictures = [lapwing.render(mesh, size=(400, 400)) for mesh in (source, target, coated)]
        matplotlib.image.imsave(arguments.picture, np.hstack(pictures))


if __name__ == "__main__":
    main()
