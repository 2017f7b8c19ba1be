#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/topology.h"

namespace lapwing {

/// The one-rings of a region at rest, in numbers of their own: what one iteration of settling
/// touches, whatever the size of the mesh around. Row r is vertex r here.
struct RegionRings {
  std::vector<Index> vertices;    ///< own number -> vertex of the mesh; rows first, then neighbours
  std::vector<Index> starts{0};   ///< entries of row r: [starts[r], starts[r + 1])
  std::vector<Index> neighbours;  ///< per entry
  std::vector<Eigen::Vector3d> edges;   ///< per entry: v_j - v_i at rest
  std::vector<double> weights;          ///< per entry: w_ij, of eq. 1
  std::vector<double> reverse_weights;  ///< per entry: w_ji; 0 where j is no row
  std::vector<double> stiffness;        ///< per entry: mu/2 times the edge's own weight; or empty
  std::vector<Index> unknown_rows;      ///< unknown, in the caller's order -> its row

  std::size_t row_count() const { return starts.size() - 1; }
  bool is_row(Index own) const { return own < row_count(); }
};

/// The rings of `rows`. `weights` as laplacian_weights gives them; `edge_weights` as the function
/// of that name does, or empty for mu = 0. `unknowns` are vertices among the rows. Linear time.
RegionRings region_rings(const Topology& topology, std::span<const Eigen::Vector3d> rest,
                         std::span<const double> weights, std::span<const double> edge_weights,
                         double stretch_resistance, std::span<const Index> rows,
                         std::span<const Index> unknowns);

}  // namespace lapwing
