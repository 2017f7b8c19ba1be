#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/energy_weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The one-rings of a region at rest with local vertex indices, so that the cost of an iteration
/// does not depend on the size of the whole mesh. Row r is local vertex r.
struct RegionRings {
  /// Mesh vertex of each local vertex: first the rows, then their other neighbours.
  std::vector<Index> vertices;
  std::vector<Index> starts{0};         ///< entries of row r: [starts[r], starts[r + 1])
  std::vector<Index> neighbours;        ///< per entry
  std::vector<Eigen::Vector3d> edges;   ///< v_j - v_i at rest, per entry
  std::vector<double> weights;          ///< w_ij of eq. 1, per entry
  std::vector<double> reverse_weights;  ///< w_ji, per entry; 0 if j is not a row
  std::vector<double> stiffness;        ///< k_ij of EnergyWeights, per entry; or empty
  std::vector<double> row_weights;      ///< om_i, per row
  std::vector<Index> unknown_rows;      ///< row of each unknown, in the caller's order

  std::size_t row_count() const { return starts.size() - 1; }
  bool is_row(Index own) const { return own < row_count(); }
};

/// Returns the rings of `rows`. `weights` are those of the whole mesh. `unknowns` must be a subset
/// of `rows`. Takes linear time.
RegionRings region_rings(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                         const EnergyWeights& weights, std::span<const Index> rows,
                         std::span<const Index> unknowns);

}  // namespace lapwing
