#pragma once

#include <algorithm>
#include <array>
#include <complex>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "lapwing/patch/patch.h"

namespace lapwing {

/// Moments closer to each other, or to 0, than this share of their size give no direction: the
/// shape is symmetric, and rounding would choose.
inline constexpr double kSymmetric = 1e-6;

/// A patch with area, seen along its mean normal from its centre of area, with its principal
/// directions as axes (right-handed, the wider one first). The view moves with the patch under
/// rotation, translation and scale. The numbers of boundary vertices decide what symmetry leaves
/// open. The arguments must outlive the object.
class PrincipalView {
 public:
  PrincipalView(const Patch& patch, std::span<const Eigen::Vector3d> own_positions);

  /// Returns the position in the view of the own vertex `v`.
  Eigen::Vector2d operator()(Index v) const { return seen(positions_[v]); }
  /// Largest distance of a vertex from the center.
  double radius() const { return radius_; }

 private:
  struct Sample {
    Eigen::Vector3d position;
    double area;
  };

  void sample_area();
  void place_center();
  void look_along_normal();
  void turn_to_principal_direction();
  void choose_sign();

  Eigen::Vector2d seen(const Eigen::Vector3d& p) const {
    return {axes_[0].dot(p - center_), axes_[1].dot(p - center_)};
  }
  void turn(double angle);
  std::complex<double> moment(int power, int rounds = 0) const;

  const Patch& patch_;
  std::span<const Eigen::Vector3d> positions_;
  std::vector<Sample> samples_;  ///< points all over the patch and their shares of its area
  double area_ = 0.0;
  double radius_ = 0.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::UnitZ();
  std::array<Eigen::Vector3d, 2> axes_{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
};

/// Returns the item with the largest score. Of items equal up to rounding in numbers of size
/// `scale`, it returns the smallest, so that a motion does not change the choice.
template <class Score>
Index best_of(std::span<const Index> items, double scale, const Score& score) {
  double best = -std::numeric_limits<double>::infinity();
  for (const Index item : items) best = std::max(best, score(item));
  Index chosen = kNoIndex;
  for (const Index item : items) {
    if (score(item) >= best - kSymmetric * scale) chosen = std::min(chosen, item);
  }
  return chosen;
}

}  // namespace lapwing
