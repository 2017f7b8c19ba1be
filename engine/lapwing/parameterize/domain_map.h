#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/patch/patch.h"

namespace lapwing {

/// The shape that patches are laid into.
enum class Domain {
  disk,    ///< the unit circle around the origin
  square,  ///< [0, 1] x [0, 1]
};

/// Where the own vertices of a patch lie in the domain.
struct DomainMap {
  Domain domain = Domain::disk;
  std::vector<Eigen::Vector2d> points;
};

/// Boundary vertices whose place in the domain is given, the rest follow by arc length between
/// them, counterclockwise: for the disk one vertex, which goes to (1, 0); for the square four, in
/// the order of the loop, which go to (0, 0), (1, 0), (1, 1), (0, 1). Own numbers.
using BoundaryPins = std::vector<Index>;

/// Pins for a patch when nobody gave any: the boundary vertex farthest along the patch's first
/// principal direction (disk); the four next to the corners of the rectangle that its two principal
/// directions span (square). Moves with the patch when that is turned, moved or scaled.
BoundaryPins default_pins(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                          Domain domain);

/// The mean value coordinates parameterization (Floater 2003) of a patch over a convex domain:
/// every inner vertex is a convex combination of its ring, so no triangle flips (Tutte, Floater).
/// `own_positions` has one position per own number of the patch. Deterministic. Throws InputError,
/// naming the vertices by their numbers in the mesh, when the pins do not fit the domain (number,
/// order, not on the boundary) or when the patch has no area.
DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins);

/// Triangles that a map turned over or flattened: signed area at most 0, relative to rounding.
std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
