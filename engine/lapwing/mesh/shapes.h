#pragma once

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Generated meshes for tests, benchmarks and the demo. Closed shapes are oriented outward.

/// (columns + 1) x (rows + 1) vertices on the unit square in z = 0, row by row, cut into triangles
/// along alternating diagonals; vertex (c, r) is number r * (columns + 1) + c. Normal +z.
Mesh grid(Index columns, Index rows);

/// Icosahedron divided `subdivisions` times onto the unit sphere: 10 * 4^s + 2 vertices.
Mesh icosphere(int subdivisions);

/// Open tube around the z axis from z = 0 to `height`: `rings` circles of `around` vertices, odd
/// circles turned by half a step. Vertex a of circle r is number r * around + a.
Mesh cylinder(Index around, Index rings, double radius, double height);

/// Torus around the z axis, `around` x `across` vertices.
Mesh torus(Index around, Index across, double radius, double tube_radius);

/// Splits every triangle of a triangle mesh into four at its edges' midpoints. Old vertices keep
/// their numbers. Attributes are dropped. Throws InputError on a face that is no triangle.
Mesh subdivide(const Mesh& mesh);

}  // namespace lapwing
