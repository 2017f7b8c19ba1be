#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/rest_stretch.h"

namespace lapwing {

/// The weight of each handle at each vertex: about 1 on the handle, about 0 on the belt, and smooth
/// in between. The weights of a vertex sum to at most 1, and to exactly 1 if only handles hold the
/// region. They provide the start of the minimization for large rotations. Interpolating a value
/// takes one n x n solve for any number of handles.
class HandleWeights {
 public:
  /// Solves for the sum of all weights. `system` must outlive the object.
  explicit HandleWeights(const EditSystem& system);

  /// Returns sum_h weight_h value_h for each vertex of the region, in the order of EditRegion::roi.
  /// Needs no solve if the values of all handles are equal up to rounding errors.
  std::vector<double> spread(std::span<const double> values) const;

  /// Returns the weights of one handle, per vertex of the region.
  std::vector<double> of_handle(std::size_t handle) const;

  /// Returns the displacements interpolated by the handle weights. Each vertex is stretched by the
  /// map of `stretch`, and then rotated and translated by the weighted motions of the handles. The
  /// rotations are interpolated from `turns`, which include whole turns, so that the surface winds
  /// with the handles.
  std::vector<Eigen::Vector3d> displacement(std::span<const Eigen::Affine3d> motions,
                                            std::span<const Eigen::AngleAxisd> turns,
                                            const RestStretch& stretch) const;

 private:
  // Interpolates values with several components. `spread_columns(count, f)[c]` interpolates the
  // values f(handle, c) over the region.
  using ValueOfHandle = std::function<double(std::size_t, std::size_t)>;
  std::vector<std::vector<double>> spread_columns(std::size_t count,
                                                  const ValueOfHandle& value) const;
  std::vector<std::vector<double>> solved_columns(const std::vector<std::size_t>& columns,
                                                  const ValueOfHandle& value) const;

  const EditSystem& system_;
  std::vector<double> sum_;     ///< sum of all weights, per vertex of the region
  std::vector<double> factor_;  ///< multiplies a solution, per vertex of the region
};

}  // namespace lapwing
