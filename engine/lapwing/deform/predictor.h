#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// Predicts the surface for the next positions of the handles. The part of the handle motion that
/// continues the recent motion extrapolates the recent change of the surface. For the remainder,
/// the surface follows the linear response of the n x n system. All fields are per vertex of the
/// edit's mesh.
class Predictor {
 public:
  void clear();

  /// Predicts the displacement of the surface for the constraints `prescribed`. The prediction
  /// starts from the pose `u`, which was computed for `last_prescribed`. Takes one n x n solve.
  std::vector<Eigen::Vector3d> predict(const EditSystem& edit,
                                       std::span<const Eigen::Vector3d> last_prescribed,
                                       std::span<const Eigen::Vector3d> prescribed,
                                       std::span<const Eigen::Vector3d> u) const;

  /// Adds a frame, which is the change from one pose to the next. The weight of each frame is twice
  /// that of the previous frame.
  void add_frame(const EditSystem& edit, std::span<const Eigen::Vector3d> last_prescribed,
                 std::span<const Eigen::Vector3d> prescribed,
                 std::span<const Eigen::Vector3d> last_u, std::span<const Eigen::Vector3d> u);

 private:
  double repeated_share(const EditSystem& edit, std::span<const Eigen::Vector3d> change) const;

  // Weighted sums of the changes in all frames; empty before the first frame.
  std::vector<Eigen::Vector3d> recent_prescribed_;
  std::vector<Eigen::Vector3d> recent_u_;
};

}  // namespace lapwing
