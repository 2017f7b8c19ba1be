#pragma once

#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/surface_point.h"

namespace lapwing {

/// Returns `values`, one per vertex, interpolated at `point`, minus `anchor`. If `anchor` is near
/// the values, differences of such offsets keep their digits, however far from 0 these are. `point`
/// must not be nowhere.
inline Eigen::Vector3d offset_from(const Eigen::Vector3d& anchor, const SurfacePoint& point,
                                   std::span<const Eigen::Vector3d> values) {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    offset += point.weights[c] * (values[point.corners[c]] - anchor);
  }
  return offset;
}

}  // namespace lapwing
