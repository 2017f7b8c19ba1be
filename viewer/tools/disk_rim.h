#pragma once

#include <optional>
#include <span>
#include <vector>

#include "tools/projection.h"

namespace lapwing::viewer {

/// A grip on the rim of a disk: dragging it resizes the disk.
struct RimGrip {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< unit normal of the surface

  /// Whether the surface faces the eye at the grip. Something nearer may still hide it.
  bool faces_eye(const Projection& projection) const {
    return normal.dot(projection.toward_eye(position)) > 0.0;
  }
};

/// Returns at most eight grips where `distances` from vertex `center` reach `radius`, in evenly
/// spaced directions. `distances` has one entry per vertex, infinity if it cannot be reached. A
/// direction in which the rim is missing gets no grip. Linear in the triangles.
std::vector<RimGrip> rim_grips(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                               std::span<const double> distances, Index center, double radius);

/// Returns the index of the nearest grip that faces the eye within a few points of `pixel`.
std::optional<std::size_t> grip_at(std::span<const RimGrip> grips, const Eigen::Vector2d& pixel,
                                   const Projection& projection);

}  // namespace lapwing::viewer
