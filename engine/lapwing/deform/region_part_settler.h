#pragma once

#include <functional>
#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"
#include "lapwing/settle/settle.h"

namespace lapwing {

/// Settles parts of one edit, each by a system of its own: the vertices are its unknowns, and the
/// rings that they are in its rows. Costs a pass over the mesh and what the part's factors cost.
class RegionPartSettler final : public PartSettler {
 public:
  /// `edit` must outlive the object and hold the n x n system whenever a part is settled.
  explicit RegionPartSettler(const EditSystem& edit);

  void settle_part(std::span<const Index> vertices, const SettleTarget& target,
                   std::span<Eigen::Vector3d> u, const GoOn& go_on,
                   const Progress& progress) override;

 private:
  const EditSystem& edit_;
  std::vector<char> in_roi_;  ///< per vertex of the mesh
};

}  // namespace lapwing
