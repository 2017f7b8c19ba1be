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

/// How many pins that is.
constexpr std::size_t pin_count(Domain domain) {
  return domain == Domain::disk ? 1 : 4;
}

/// Pins for a patch when nobody gave any, from its principal directions as seen along its mean
/// normal: the boundary vertex farthest along the first one (disk); the four next to the corners of
/// the rectangle along both around the boundary (square). Where those four are not in order, as on
/// winding boundaries, the four that are a quarter of the boundary apart, from the first on. Moves
/// with the patch when that is turned, moved or scaled, symmetric ones too. Throws InputError for
/// the square when the boundary has fewer than four vertices.
BoundaryPins default_pins(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                          Domain domain);

/// The mean value coordinates parameterization (Floater 2003) of a patch over a convex domain:
/// every inner vertex is a convex combination of its ring, so no triangle flips (Tutte, Floater).
/// `own_positions` has one position per own number of the patch. Deterministic. Throws InputError,
/// naming the vertices by their numbers in the mesh, when the pins do not fit the domain (number,
/// order, not on the boundary), or when the patch has no area or a vertex that is not finite. Where
/// the boundary is short and the patch reaches far, inner triangles become smaller than the
/// rounding of coordinates, and `flipped_triangles` may find some.
DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins);

/// Triangles that a map turned over or flattened: signed area at most 0, relative to rounding.
std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Eigen::Vector2d> points);

}  // namespace lapwing
