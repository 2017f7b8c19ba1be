#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/projection.h"

namespace lapwing::viewer {

/// A place on the rim of a disk by which a hand takes hold of it.
struct RimGrip {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< of the surface there; length 1

  /// Whether its side of the surface is seen; something else may still stand before it.
  bool faces_eye(const Projection& projection) const {
    return normal.dot(projection.toward_eye(position)) > 0.0;
  }
};

/// At most eight places, evenly around vertex `center`, where the distances from there reach
/// `radius`; one per vertex, infinity where there is none. Fewer where the surface ends before or
/// goes around. Linear in the triangles.
std::vector<RimGrip> rim_grips(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                               std::span<const double> distances, Index center, double radius);

/// The nearest of those that face the eye within a few points of `pixel`.
std::optional<std::size_t> grip_at(std::span<const RimGrip> grips, const Eigen::Vector2d& pixel,
                                   const Projection& projection);

}  // namespace lapwing::viewer
