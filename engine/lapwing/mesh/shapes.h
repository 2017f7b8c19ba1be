#pragma once

#include <span>
#include <string_view>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Generated meshes for tests, benchmarks and the demo. Closed shapes are oriented outward. All
/// throw InputError for more than kMostTriangles.

/// (columns + 1) x (rows + 1) vertices on the unit square in z = 0, row by row, cut into triangles
/// along alternating diagonals; vertex (c, r) is number r * (columns + 1) + c. Normal +z.
Mesh grid(Index columns, Index rows);

/// Icosahedron, subdivided `subdivisions` times and projected onto the unit sphere: 10 * 4^s + 2
/// vertices.
Mesh icosphere(int subdivisions);

/// Open tube around the z axis from z = 0 to `height`: `rings` circles of `around` vertices, odd
/// circles turned by half a step. Vertex a of circle r is number r * around + a.
Mesh cylinder(Index around, Index rings, double radius, double height);

/// A cylinder of radius 0.5 and height 6 whose radius ripples by 3%, eight times around and ten
/// times along. Tests of large rotations check that the ripples survive.
Mesh rippled_cylinder(Index around = 60, Index rings = 121);

/// The grid of `cells` x `cells` squares with `bumps` x `bumps` round hills of height `height`.
Mesh bumpy_plane(Index cells, Index bumps, double height);

/// Closed bar with square ends around the z axis from z = 0 to `length`. Its ends have `across` x
/// `across` squares and its sides `along` rows of `across`, all cut into two triangles.
Mesh bar(Index across, Index along, double width, double length);

/// Torus around the z axis, `around` x `across` vertices.
Mesh torus(Index around, Index across, double radius, double tube_radius);

/// A generated mesh of a size fit for experiments.
struct NamedShape {
  std::string_view name;
  Mesh (*make)();
};
/// Returns "tube", "sphere", "sheet", ... and the start shapes of the classic deformation tests.
std::span<const NamedShape> named_shapes();

}  // namespace lapwing
