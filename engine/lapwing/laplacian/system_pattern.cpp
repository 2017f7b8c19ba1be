#include "lapwing/laplacian/system_pattern.h"

#include "lapwing/solve/ordering.h"

namespace lapwing {

SystemPattern::SystemPattern(const Topology& topology, std::span<const Index> roi,
                             const Unknowns& unknowns)
    : normal_(ring_blocks(topology.rings, roi), unknowns) {}

const std::vector<int>& SystemPattern::order() const {
  std::call_once(ordered_,
                 [&] { order_ = fill_reducing_order(normal_.blocks(), Ordering::minimum_degree); });
  return order_;
}

const std::vector<int>& SystemPattern::thorough_order() const {
  if (blocks().size() <= kMinimumDegreeLimit) return order();
  std::call_once(thoroughly_ordered_, [&] {
    thorough_order_ = fill_reducing_order(normal_.blocks(), Ordering::nested_dissection);
  });
  return thorough_order_;
}

}  // namespace lapwing
