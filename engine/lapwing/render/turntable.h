#pragma once

#include <span>

#include "lapwing/render/camera.h"

namespace lapwing {

/// A camera that orbits once around the upward axis through the middle of the points, at constant
/// height and distance, so that nothing grows or shrinks.
class Turntable {
 public:
  /// Keeps all finite `points` in the picture on the whole orbit, as large as the margin allows.
  /// The orbit starts at `first.toward_eye`, with `first.up` upwards in the picture. O(n log n).
  Turntable(std::span<const Eigen::Vector3d> points, const ViewAxes& first, UpAxis up_axis,
            double aspect, const Framing& framing = {});

  /// Returns the camera of step `step` of `steps`, above 0. Step 0 is the start; steps go to the
  /// right. Step `steps` is step 0 again, so that the pictures loop without a jump.
  Camera camera(int step, int steps) const;

 private:
  Eigen::Vector3d middle_;  ///< on the axis
  Eigen::Vector3d upward_;
  Camera first_;
};

}  // namespace lapwing
