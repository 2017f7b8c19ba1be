#include "lapwing/laplacian/region_rings.h"

#include <algorithm>

#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

// Returns the entry of vertex j in ring i of the whole mesh.
std::size_t entry_of(const Adjacency& rings, Index i, Index j) {
  const auto ring = rings[i];
  return rings.starts[i] +
         static_cast<std::size_t>(std::lower_bound(ring.begin(), ring.end(), j) - ring.begin());
}

}  // namespace

RegionRings region_rings(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                         const EnergyWeights& weights, std::span<const Index> rows,
                         std::span<const Index> unknowns) {
  constexpr std::size_t kRowsPerTask = 1024;
  const Adjacency& rings = topology.rings;
  RegionRings result;
  result.vertices.assign(rows.begin(), rows.end());
  std::vector<Index> own_number(rest.size(), kNoIndex);
  for (std::size_t r = 0; r < rows.size(); ++r) own_number[rows[r]] = static_cast<Index>(r);
  for (const Index i : rows) {
    for (const Index j : rings[i]) {
      if (own_number[j] != kNoIndex) continue;
      own_number[j] = static_cast<Index>(result.vertices.size());
      result.vertices.push_back(j);
    }
    result.starts.push_back(result.starts.back() + static_cast<Index>(rings.size(i)));
  }
  const std::size_t entries = result.starts.back();
  result.neighbours.resize(entries);
  result.edges.resize(entries);
  result.weights.resize(entries);
  result.reverse_weights.resize(entries);
  if (!weights.stiffness.empty()) result.stiffness.resize(entries);
  result.row_weights.resize(rows.size(), 1.0);
  parallel_for(rows.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t r = begin; r < end; ++r) {
      const Index i = rows[r];
      if (!weights.rows.empty()) result.row_weights[r] = weights.rows[i];
      std::size_t to = result.starts[r];
      for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e, ++to) {
        const Index j = rings.values[e];
        const bool row = own_number[j] < rows.size();
        result.neighbours[to] = own_number[j];
        result.edges[to] = rest[j] - rest[i];
        result.weights[to] = weights.laplacian[e];
        result.reverse_weights[to] = row ? weights.laplacian[entry_of(rings, j, i)] : 0.0;
        if (!weights.stiffness.empty()) result.stiffness[to] = weights.stiffness[e];
      }
    }
  });
  for (const Index v : unknowns) result.unknown_rows.push_back(own_number[v]);
  return result;
}

}  // namespace lapwing
