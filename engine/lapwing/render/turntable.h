#pragma once

#include <span>

#include "lapwing/render/camera.h"

namespace lapwing {

/// A camera that orbits once around the up axis through the centre of the points, at constant
/// height and distance, so that the size of the object in the image stays constant.
class Turntable {
 public:
  /// Shows all finite `points` on the whole orbit, as large as the margin allows. The orbit starts
  /// in the direction `first.toward_eye`, with `first.up` upwards in the image. O(n log n).
  Turntable(std::span<const Eigen::Vector3d> points, const ViewAxes& first, UpAxis up_axis,
            double aspect, const Framing& framing = {});

  /// Returns the camera of step `step` of `steps`, which must be positive. The camera starts at
  /// step 0 and moves to the right. Step `steps` equals step 0, so the images form a closed loop.
  Camera camera(int step, int steps) const;

 private:
  Eigen::Vector3d middle_;  ///< a point of the axis
  Eigen::Vector3d upward_;
  Camera first_;
};

}  // namespace lapwing
