#pragma once

#include <span>

#include "lapwing/render/camera.h"

namespace lapwing {

/// A camera that goes once around the upward axis through the middle of what it shows, at one
/// height and distance, so that nothing grows or shrinks on the way.
class Turntable {
 public:
  /// All finite `points` are in the picture from everywhere on the way, as large as the margin
  /// allows. `first.toward_eye` says where the way begins; `first.up` what is up in the picture
  /// there. Linear in the points.
  Turntable(std::span<const Eigen::Vector3d> points, const ViewAxes& first, UpAxis up_axis,
            double aspect, const Framing& framing = {});

  /// Of step `step` of `steps`, above 0: from 0, where it begins, to the right. Step `steps` is
  /// step 0 again, so that the pictures before it go on without a jump.
  Camera camera(int step, int steps) const;

 private:
  Eigen::Vector3d middle_;  ///< on the axis
  Eigen::Vector3d upward_;
  Camera first_;
};

}  // namespace lapwing
