#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/held_factor.h"
#include "lapwing/laplacian/region_rings.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/laplacian/weights.h"

namespace lapwing {

/// The factored n x n system (L'L + W + mu K) u = b of one region, the same for x, y and z (DESIGN
/// sections 3 and 4). K is the matrix of the edge energy sum_ij w_ij |u_i - u_j|^2 / 2, each row
/// counting the edges of its ring, w as edge_weights gives them.
class LaplacianSystem {
 public:
  /// Assembles and factors; stage "laplacian". `topology` and `pattern` must outlive the object;
  /// `stretch_resistance` is mu. Throws SolverError, naming the vertex, where a component is not
  /// held.
  LaplacianSystem(std::span<const Eigen::Vector3d> rest, const Topology& topology,
                  std::span<const Index> roi, const Constraints& constraints,
                  const SystemPattern& pattern, LaplacianWeights weights, double stretch_resistance,
                  StageTimings& timings);

  /// The same, not ready for anything yet: for who makes it ready step by step, and again when
  /// positions, weights or constraints have become others. Its steps are `assemble`, `analyze` (in
  /// any order, or beside each other), `factor`, and `make_rings` for who needs the rings.
  LaplacianSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                  const SystemPattern& pattern);

  /// L and L'L + mu K, for which neither order nor constraints are needed.
  void assemble(std::span<const Eigen::Vector3d> rest, LaplacianWeights weights,
                double stretch_resistance);
  /// Order and symbolic factorization, for which the pattern is enough. Nothing the second time.
  void analyze();
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// The factor under `W`, one number per unknown; redoes what has changed since the last time.
  /// Throws SolverError as above; all but the factor is kept then.
  void factor(std::span<const double> W);
  /// `rings()`, and with it the order of elimination, of the positions last assembled.
  void make_rings(std::span<const Eigen::Vector3d> rest);

  /// Unknowns and their rows come in the order of elimination, so that neighbours in space are
  /// neighbours in memory: unknown k of these is unknown `elimination_order()[k]`.
  const RegionRings& rings() const { return rings_; }
  const std::vector<int>& elimination_order() const { return pattern_.order(); }
  const Constraints& constraints() const { return constraints_; }
  std::string_view solver_name() const { return factor_.solver().name(); }
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
  std::vector<Index> rows_by_elimination();
  void add_edge_terms(BlockMatrix& A) const;
  std::vector<double> from_given(std::span<const Eigen::Vector3d> given) const;

  const Topology& topology_;
  const SystemPattern& pattern_;
  VertexSet roi_;
  Constraints constraints_;
  double stretch_resistance_ = 0.0;
  BlockRows L_;
  std::vector<double> weights_;       ///< per entry of the mesh's rings, as the next
  std::vector<double> edge_weights_;  ///< or empty for mu = 0
  bool has_rings_ = false;
  RegionRings rings_;
  std::vector<Index> places_;  ///< unknown -> where it stands in the order of elimination
  HeldFactor factor_;
};

}  // namespace lapwing
