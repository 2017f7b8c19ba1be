#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/rest_stretch.h"

namespace lapwing {

/// The weight of each handle at each vertex: about 1 on the handle, about 0 on the belt, smooth
/// between. The weights of a vertex sum to at most 1, and to 1 if only handles hold the region.
/// Large rotations start from them. Interpolating a value by them costs one n x n solve, however
/// many handles there are.
class HandleWeights {
 public:
  /// Solves for the sum of all weights. `system` must outlive the object.
  explicit HandleWeights(const EditSystem& system);

  /// Returns sum_h weight_h value_h per vertex of the region, in the order of EditRegion::roi.
  /// Solves nothing if the values of all handles are equal but for rounding.
  std::vector<double> spread(std::span<const double> values) const;

  /// The weights of one handle, per vertex of the region.
  std::vector<double> of_handle(std::size_t handle) const;

  /// Returns the displacements interpolated by the handle weights. Each vertex is stretched by the
  /// map of `stretch`, and then rotated and translated by the weighted motions of the handles. The
  /// rotations are interpolated from `turns`, which include whole turns, so that the surface winds
  /// with the handles.
  std::vector<Eigen::Vector3d> displacement(std::span<const Eigen::Affine3d> motions,
                                            std::span<const Eigen::AngleAxisd> turns,
                                            const RestStretch& stretch) const;

 private:
  // Fields over the region, one for each number of a value: `spread_columns(3, f)[c]` for
  // f(handle, c).
  using ValueOfHandle = std::function<double(std::size_t, std::size_t)>;
  std::vector<std::vector<double>> spread_columns(std::size_t count,
                                                  const ValueOfHandle& value) const;
  std::vector<std::vector<double>> solved_columns(const std::vector<std::size_t>& columns,
                                                  const ValueOfHandle& value) const;

  const EditSystem& system_;
  std::vector<double> sum_;     ///< of all weights, per vertex of the region
  std::vector<double> factor_;  ///< multiplies a solution, per vertex of the region
};

}  // namespace lapwing
