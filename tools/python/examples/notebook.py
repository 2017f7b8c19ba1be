"""A notebook session: each part between `# %%` is a cell in Jupyter or an editor.

    notebook.py [MESH VERTEX RADIUS] [OUT.png]

Without a mesh it bends a tube.
"""

# %% A mesh, a region, and its handle
import sys

import matplotlib
import numpy as np

if "ipykernel" not in sys.modules:
    matplotlib.use("agg")
import matplotlib.pyplot as plt

import lapwing

if len(sys.argv) > 3:
    mesh, center, radius = lapwing.read(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3])
    roi = {"disk": {"center": center, "radius": radius}}
    hand, belt = {"disk": {"center": center, "radius": radius / 3}}, 0.1
else:
    mesh = lapwing.shape("tube")
    height = mesh.vertices[:, 2]
    roi, hand, belt = "all", height > np.quantile(height, 0.95), height < np.quantile(height, 0.05)

# %% Check the mesh
found = lapwing.check(mesh)
print(mesh, "genus", found.statistics["genus"], "and", len(found.defects), "kinds of defects")

# %% Prepare once, and bend the mesh to three angles
deformer = lapwing.Deformer(mesh, roi=roi, belt=belt, handles=[hand])
center = mesh.vertices[deformer.roi].mean(0)
motions = np.tile(np.eye(4), (3, 1, 1, 1))
for motion, degrees in zip(motions[:, 0], (20, 45, 70)):
    angle = np.radians(degrees)
    motion[:3, :3] = [[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]]
    motion[:3, 3] = center - motion[:3, :3] @ center
many = deformer.solve_many(motions)

# %% Show the rotation of each vertex
figure, axes = plt.subplots(1, 4, figsize=(16, 4))
axes[0].imshow(lapwing.render(mesh, size=(400, 400)))
for axis, motion, vertices in zip(axes[1:], motions, many.vertices):
    rotations = deformer.solve(motion).rotations
    traces = np.trace(rotations, axis1=1, axis2=2)
    degrees = np.degrees(np.arccos(np.clip((traces - 1) / 2, -1, 1)))
    picture = lapwing.render(
        mesh.with_vertices(vertices), values=degrees, limits=(0, 70), legend="turned by, degrees",
        size=(400, 400),
    )
    axis.imshow(picture)
for axis in axes:
    axis.axis("off")
figure.tight_layout()
figure.savefig(sys.argv[-1] if sys.argv[-1].endswith(".png") else "turned.png")
