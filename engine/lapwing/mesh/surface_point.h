#pragma once

#include <array>
#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// A point on a triangulated surface: sum_k weights[k] * (position of corners[k]). Weights are at
/// least 0 and sum to 1. For `nowhere()` all weights are 0, and so is every value.
struct SurfacePoint {
  std::array<Index, 3> corners{};
  std::array<double, 3> weights{};

  static SurfacePoint at_vertex(Index v) { return {{v, v, v}, {1.0, 0.0, 0.0}}; }
  static SurfacePoint nowhere() { return {}; }
  bool is_nowhere() const { return weights[0] == 0.0 && weights[1] == 0.0 && weights[2] == 0.0; }

  /// Returns the value at the point, interpolated linearly from `values`, one per vertex.
  template <class Value>
  Value of(std::span<const Value> values) const {
    return Value(weights[0] * values[corners[0]] + weights[1] * values[corners[1]] +
                 weights[2] * values[corners[2]]);
  }
};

}  // namespace lapwing
