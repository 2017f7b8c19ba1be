#pragma once

#include <functional>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/edit_system.h"
#include "lapwing/deform/rest_stretch.h"

namespace lapwing {

/// How far every vertex goes along with each handle: 1 on it, 0 on the belt, smoothly between; in
/// all at most 1, and 1 where nothing but handles holds the region. Large rotations
/// start from them. What is spread over
/// the surface by its shares costs one column of the n x n system, however many handles there are.
class HandleWeights {
 public:
  /// Solves for the shares of all handles together. `system` holds the n x n system, as for every
  /// call, and must outlive the object.
  explicit HandleWeights(const EditSystem& system);

  /// sum_h share_h value_h per vertex of the region, in the order of EditRegion::roi. Solves
  /// nothing where the values of all handles are the same but for rounding.
  std::vector<double> spread(std::span<const double> values) const;

  /// Of one handle, per vertex of the region.
  std::vector<double> of_handle(std::size_t handle) const;

  /// The displacement of every vertex where each makes a share of the handles' motions, and with it
  /// of their whole turns, whose rotations came about by `turns`: the surface is wound the way the
  /// handles went. A linear response knows a handle's rotation but not its turn.
  /// The surface is first stretched by the smooth map of `stretch`.
  std::vector<Eigen::Vector3d> turned(std::span<const Eigen::Affine3d> motions,
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
  std::vector<double> sum_;     ///< of all handles' shares, per vertex of the region
  std::vector<double> factor_;  ///< by which a solution is to be taken, likewise
};

}  // namespace lapwing
