#include "lapwing/elastic/prepared_region.h"

#include <cstring>

#include "lapwing/elastic/factor_cache.h"

namespace lapwing {

bool same_bits(std::span<const Eigen::Vector3d> a, std::span<const Eigen::Vector3d> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

bool PreparedRegion::serves(const VertexSet& roi, const Unknowns& unknowns) const {
  return factors_ != nullptr && factors_->serves(roi, unknowns);
}

std::shared_ptr<FactorCache> PreparedRegion::factors_of(const VertexSet& roi,
                                                        const Unknowns& unknowns) {
  if (!serves(roi, unknowns)) {
    factors_.reset();  // frees the old factors before new ones are created, because they are large
    factors_ = std::make_shared<FactorCache>(topology_, roi, unknowns);
  }
  return factors_;
}

std::shared_ptr<const Positions> PreparedRegion::copy_of(std::span<const Eigen::Vector3d> rest) {
  const bool same = rest_ != nullptr && same_bits(*rest_, rest);
  if (!same) rest_ = std::make_shared<const Positions>(rest.begin(), rest.end());
  return rest_;
}

}  // namespace lapwing
