#include "lapwing/laplacian/region_rings.h"

#include <algorithm>

namespace lapwing {
namespace {

// Where vertex j stands in ring i of the whole mesh.
std::size_t entry_of(const Adjacency& rings, Index i, Index j) {
  const auto ring = rings[i];
  return rings.starts[i] +
         static_cast<std::size_t>(std::lower_bound(ring.begin(), ring.end(), j) - ring.begin());
}

}  // namespace

RegionRings region_rings(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                         std::span<const double> weights, std::span<const double> edge_weights,
                         double stretch_resistance, std::span<const Index> rows,
                         std::span<const Index> unknowns) {
  const Adjacency& rings = topology.rings;
  RegionRings result;
  result.vertices.assign(rows.begin(), rows.end());
  std::vector<Index> own_number(rest.size(), kNoIndex);
  for (std::size_t r = 0; r < rows.size(); ++r) own_number[rows[r]] = static_cast<Index>(r);
  for (const Index i : rows) {
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      const Index j = rings.values[e];
      const bool row = own_number[j] < rows.size();
      if (own_number[j] == kNoIndex) {
        own_number[j] = static_cast<Index>(result.vertices.size());
        result.vertices.push_back(j);
      }
      result.neighbours.push_back(own_number[j]);
      result.edges.push_back(rest[j] - rest[i]);
      result.weights.push_back(weights[e]);
      result.reverse_weights.push_back(row ? weights[entry_of(rings, j, i)] : 0.0);
      // Each end of an edge holds it by half.
      if (!edge_weights.empty()) {
        result.stiffness.push_back(0.5 * stretch_resistance * edge_weights[e]);
      }
    }
    result.starts.push_back(static_cast<Index>(result.neighbours.size()));
  }
  for (const Index v : unknowns) result.unknown_rows.push_back(own_number[v]);
  return result;
}

}  // namespace lapwing
