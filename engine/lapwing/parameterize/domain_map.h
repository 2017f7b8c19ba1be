#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/parameterize/patch.h"

namespace lapwing {

/// The planar shape to which patches are mapped.
enum class Domain {
  disk,    ///< the unit circle around the origin
  square,  ///< [0, 1] x [0, 1]
};

/// The places of a patch's vertices in the domain, per own number.
struct DomainMap {
  Domain domain = Domain::disk;
  std::vector<Eigen::Vector2d> points;
};

/// Boundary vertices with a fixed place in the domain, in own numbers. The others follow by arc
/// length between them, counterclockwise. The disk has one, at (1, 0). The square has four, in the
/// order of the loop, at (0, 0), (1, 0), (1, 1), (0, 1).
using BoundaryPins = std::vector<Index>;

/// Returns the number of pins that a domain needs.
constexpr std::size_t pin_count(Domain domain) {
  return domain == Domain::disk ? 1 : 4;
}

/// Returns pins for a patch, from its principal directions as seen along its mean normal. For the
/// disk this is the boundary vertex farthest along the first direction. For the square these are
/// the four next to the corners of the boundary's rectangle along both directions or, if those are
/// not in order, as on winding boundaries, the first of them and three others, each a quarter of
/// the boundary apart. The pins move with the patch under rotation, translation and scale, even if
/// it is symmetric. Throws InputError for the square if the boundary has fewer than four vertices.
BoundaryPins default_pins(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                          Domain domain);

/// Returns the mean value coordinates parameterization (Floater 2003) of a patch over a convex
/// domain. Every inner vertex is a convex combination of its ring, so no triangle flips (Tutte,
/// Floater). `own_positions` has one position per own number of the patch. Deterministic. Throws
/// InputError, naming the vertices of the mesh, if the pins do not fit the domain (number, order,
/// not on the boundary), or if the patch has no area or a vertex that is not finite. If the
/// boundary is short and the patch reaches far, inner triangles become smaller than the rounding of
/// coordinates, and `flipped_triangles` may find some.
DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins);

/// Returns triangles that a map flipped or flattened: signed area at most 0, up to rounding.
std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Eigen::Vector2d> points);

/// Returns the places of `patch.loop` in the domain, in its order, at which `mean_value_map` holds
/// it. A boundary edge counts as at least kShortestBoundaryEdge mean edge lengths long, so that no
/// two vertices coincide. Throws what `mean_value_map` throws about pins.
std::vector<Eigen::Vector2d> boundary_points(const Patch& patch,
                                             std::span<const Eigen::Vector3d> own_positions,
                                             Domain domain, const BoundaryPins& pins);

/// Small enough to leave ordinary boundaries alone, large enough to stay clear of rounding.
inline constexpr double kShortestBoundaryEdge = 1e-4;

}  // namespace lapwing
