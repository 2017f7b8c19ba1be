#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/surface_point.h"

namespace lapwing {

/// What `values`, one per vertex, are at `point`, less `anchor`. Differences of two such offsets
/// from a value nearby keep their digits however far from 0 the values lie. `point` is not nowhere.
inline Eigen::Vector3d offset_from(const Eigen::Vector3d& anchor, const SurfacePoint& point,
                                   std::span<const Eigen::Vector3d> values) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    offset += point.weights[c] * (values[point.corners[c]] - anchor);
  }
  return offset;
}

}  // namespace lapwing
