#include "studies/real/edge_ratio.h"

#include <algorithm>

namespace lapwing::bench {

double largest_edge_ratio(std::span<const Index> rows, const Topology& topology,
                          std::span<const Eigen::Vector3d> rest,
                          std::span<const Eigen::Vector3d> current) {
  double largest = 0.0;
  for (const Index i : rows) {
    for (const Index j : topology.rings[i]) {
      const double was = (rest[i] - rest[j]).norm();
      if (was > 0.0) largest = std::max(largest, (current[i] - current[j]).norm() / was);
    }
  }
  return largest;
}

}  // namespace lapwing::bench
