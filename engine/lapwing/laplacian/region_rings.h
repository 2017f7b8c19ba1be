#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/energy_weights.h"
#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The one-rings of a region at rest with a local numbering, so that the cost of an iteration does
/// not depend on the size of the mesh around. Row r is local vertex r.
struct RegionRings {
  std::vector<Index> vertices;    ///< local number -> vertex of the mesh; rows, then neighbours
  std::vector<Index> starts{0};   ///< entries of row r: [starts[r], starts[r + 1])
  std::vector<Index> neighbours;  ///< per entry
  std::vector<Eigen::Vector3d> edges;   ///< per entry: v_j - v_i at rest
  std::vector<double> weights;          ///< per entry: w_ij, of eq. 1
  std::vector<double> reverse_weights;  ///< per entry: w_ji; 0 if j is no row
  std::vector<double> stiffness;        ///< per entry: k_ij, of EnergyWeights; or empty
  std::vector<double> row_weights;      ///< per row: om_i
  std::vector<Index> unknown_rows;      ///< unknown, in the caller's order -> its row

  std::size_t row_count() const { return starts.size() - 1; }
  bool is_row(Index own) const { return own < row_count(); }
};

/// Returns the rings of `rows`. `weights` are those of the whole mesh. `unknowns` must be among the
/// rows. Linear time.
RegionRings region_rings(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                         const EnergyWeights& weights, std::span<const Index> rows,
                         std::span<const Index> unknowns);

}  // namespace lapwing
