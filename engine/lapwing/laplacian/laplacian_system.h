#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/region_rings.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/solve/block_solver.h"

namespace lapwing {

/// The factored n x n system (L'L + W + mu K) u = b of one region, the same for x, y and z (DESIGN
/// sections 3 and 4). K is the matrix of the edge energy sum_ij w_ij |u_i - u_j|^2 / 2, each row
/// counting the edges of its ring, w as edge_weights gives them.
class LaplacianSystem {
 public:
  /// Assembles and factors; stage "laplacian". `constraints` and `pattern` must outlive the object;
  /// `stretch_resistance` is mu. Throws SolverError, naming the vertex, where a component is not
  /// held.
  LaplacianSystem(std::span<const Eigen::Vector3d> rest, const Topology& topology,
                  std::span<const Index> roi, const Constraints& constraints,
                  const SystemPattern& pattern, LaplacianWeights weights, double stretch_resistance,
                  StageTimings& timings);

  /// Unknowns and their rows come in the order of elimination, so that neighbours in space are
  /// neighbours in memory: unknown k of these is unknown `elimination_order()[k]`.
  const RegionRings& rings() const { return rings_; }
  const std::vector<int>& elimination_order() const { return pattern_.order(); }
  const Constraints& constraints() const { return constraints_; }
  std::size_t size() const { return constraints_.unknowns.size(); }

  /// b = W d - (L'L + mu K) d', d what `wanted` (one vector for each vertex of the mesh) says for
  /// unknowns that are held, d' for vertices of the region whose motion is given. x of all
  /// unknowns, then y, then z.
  void right_hand_side(std::span<const Eigen::Vector3d> wanted, std::span<double> b) const;

  /// Replaces `columns` right-hand sides of `size()` numbers, one after the other, by their
  /// solutions. Allocates nothing from the second call on. One thread at a time.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;
  /// As `solve_in_place`, the unknowns in the order of elimination.
  void solve_in_elimination_order(std::span<double> columns_of_b, std::size_t columns) const;

 private:
  std::vector<Index> rows_by_elimination(std::span<const Index> roi);
  void add_edge_terms(BlockMatrix& A) const;
  std::vector<double> from_given(std::span<const Eigen::Vector3d> given) const;

  const Constraints& constraints_;
  const SystemPattern& pattern_;
  RegionRings rings_;
  BlockRows L_;
  std::vector<Index> places_;  ///< unknown -> where it stands in the order of elimination
  std::unique_ptr<BlockSolver> solver_;
};

}  // namespace lapwing
