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

/// The points of a patch's vertices in the domain, by local index.
struct DomainMap {
  Domain domain = Domain::disk;
  std::vector<Eigen::Vector2d> points;
};

/// Local indices of boundary vertices with given points in the domain. The boundary vertices
/// between them are distributed by arc length, counterclockwise. The disk has one pin, at (1, 0).
/// The square has four, in the order of the loop, at (0, 0), (1, 0), (1, 1) and (0, 1).
using BoundaryPins = std::vector<Index>;

constexpr std::size_t pin_count(Domain domain) {
  return domain == Domain::disk ? 1 : 4;
}

/// Returns pins for a patch, from the principal directions of its projection along the mean normal.
/// The pin of the disk is the boundary vertex farthest along the first direction. The pins of the
/// square are the boundary vertices nearest to the corners of the bounding rectangle. If these are
/// not in order, as on a winding boundary, only the first is used, and the others follow at
/// quarters of the boundary length. The choice is invariant under rotation, translation and
/// scaling, even for symmetric patches. Throws InputError for the square if the boundary has fewer
/// than four vertices.
BoundaryPins default_pins(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                          Domain domain);

/// Returns the mean value coordinates parameterization (Floater 2003) of a patch over a convex
/// domain. Every inner vertex is a convex combination of its neighbours, so no triangle flips
/// (Tutte, Floater). `own_positions` has one position per local index. Deterministic. Throws
/// InputError, which names vertices of the mesh, if the pins have a wrong number or order or are
/// not on the boundary, or if the patch has zero area or a non-finite position. On long protrusions
/// with a short boundary, triangles can become smaller than rounding errors, and
/// `flipped_triangles` may find some.
DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins);

/// Returns the triangles that a map flipped or flattened: their signed area is at most 0 up to
/// rounding errors.
std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Eigen::Vector2d> points);

/// Returns the points to which `mean_value_map` maps the vertices of `patch.loop`, in the order of
/// the loop. Boundary edges are treated as at least kShortestBoundaryEdge mean edge lengths long,
/// so that no two points coincide. Throws the errors of `mean_value_map` about pins.
std::vector<Eigen::Vector2d> boundary_points(const Patch& patch,
                                             std::span<const Eigen::Vector3d> own_positions,
                                             Domain domain, const BoundaryPins& pins);

/// Small enough to have no effect on ordinary boundaries, and large compared with rounding errors.
inline constexpr double kShortestBoundaryEdge = 1e-4;

}  // namespace lapwing
