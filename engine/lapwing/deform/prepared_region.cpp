#include "lapwing/deform/prepared_region.h"

#include <cstring>

#include "lapwing/deform/region_system.h"

namespace lapwing {

bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

bool PreparedRegion::serves(const VertexSet& roi, const Unknowns& unknowns) const {
  const auto serves = [&](const auto& system) {
    return system != nullptr && system->serves(roi, unknowns);
  };
  return serves(system_) || serves(like_);
}

std::shared_ptr<RegionSystem> PreparedRegion::system_of(const VertexSet& roi,
                                                        const Unknowns& unknowns) {
  if (system_ != nullptr && system_->serves(roi, unknowns)) return system_;
  system_.reset();  // factors are large: the ones before go first
  system_ = serves(roi, unknowns) ? like_->beside()
                                  : std::make_shared<RegionSystem>(topology_, roi, unknowns);
  return system_;
}

std::shared_ptr<const Positions> PreparedRegion::copy_of(std::span<const Eigen::Vector3d> rest) {
  const bool same = rest_ != nullptr && same_bits(*rest_, rest);
  if (!same) rest_ = std::make_shared<const Positions>(rest.begin(), rest.end());
  return rest_;
}

}  // namespace lapwing
