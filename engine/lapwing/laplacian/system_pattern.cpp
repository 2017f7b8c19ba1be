#include "lapwing/laplacian/system_pattern.h"

#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

// Larger ones save little of the search and cost more of the factorization.
constexpr int kLargestCluster = 4;

// Each unknown with neighbours on the mesh that are in no cluster yet.
std::vector<Index> clusters_of(const Adjacency& rings, const Unknowns& unknowns) {
  std::vector<Index> cluster_of(unknowns.size(), kNoIndex);
  Index count = 0;
  for (std::size_t u = 0; u < unknowns.size(); ++u) {
    if (cluster_of[u] != kNoIndex) continue;
    cluster_of[u] = count;
    int size = 1;
    for (const Index j : rings[unknowns.vertices[u]]) {
      const Index other = unknowns.of_vertex[j];
      if (size == kLargestCluster) break;
      if (other == kNoIndex || cluster_of[other] != kNoIndex) continue;
      cluster_of[other] = count;
      ++size;
    }
    ++count;
  }
  return cluster_of;
}

}  // namespace

SystemPattern::SystemPattern(const Topology& topology, std::span<const Index> roi,
                             const Unknowns& unknowns)
    : normal_(ring_blocks(topology.rings, roi), unknowns) {
  if (unknowns.size() > kMinimumDegreeLimit) cluster_of_ = clusters_of(topology.rings, unknowns);
}

const std::vector<int>& SystemPattern::order() const {
  std::call_once(ordered_, [&] {
    order_ = cluster_of_.empty() ? fill_reducing_order(normal_.blocks(), Ordering::minimum_degree)
                                 : clustered_order(normal_.blocks(), cluster_of_);
  });
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
