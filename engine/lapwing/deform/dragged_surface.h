#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/settled_pose.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The surface of an edit on the device, dragged by the columns of its basis from a pose on: what a
/// preview and a Deformer do alike.
class DraggedSurface {
 public:
  DraggedSurface(std::shared_ptr<const EditSystem> system,
                 std::unique_ptr<DeformedSurface> surface);

  /// As Deformer's of that name.
  void drag(std::span<const Eigen::Affine3d> motions);
  void drag_from(const SettledPose& pose);

  DeformedSurface& surface() { return *surface_; }

 private:
  std::shared_ptr<const EditSystem> system_;
  std::unique_ptr<DeformedSurface> surface_;
  std::vector<double> parameters_;  ///< of the frame at hand
  std::vector<double> base_;        ///< of the pose that drags begin from
};

/// As Deformer::pose_at.
SettledPose pose_at(const EditSystem& system, std::span<const Eigen::Vector3d> positions,
                    std::span<const Eigen::Affine3d> motions,
                    std::span<const Eigen::AngleAxisd> turns);

}  // namespace lapwing
