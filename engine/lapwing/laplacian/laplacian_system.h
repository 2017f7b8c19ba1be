#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/stopwatch.h"
#include "lapwing/laplacian/constrained_factor.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/energy_weights.h"
#include "lapwing/laplacian/region_rings.h"
#include "lapwing/laplacian/rsi_system.h"
#include "lapwing/laplacian/springs.h"
#include "lapwing/laplacian/system_pattern.h"

namespace lapwing {

/// The factored n x n system (L'Om L + K + W) u = b of one region, the same for x, y and z
/// (ENERGY.md sections 3 and 4). Om are the weights of the rows and K the matrix of the edge energy
/// sum_ij k_ij |u_i - u_j|^2, each row counting the edges of its ring (EnergyWeights); without a
/// detail length this is L'L + W. Springs, where there are any, are part of K.
class LaplacianSystem {
 public:
  /// Assembles and factors; stage "laplacian". `topology` and `pattern` must outlive the object.
  /// Throws SolverError, naming the vertex, where a component is not held.
  LaplacianSystem(std::span<const Eigen::Vector3d> rest, const Topology& topology,
                  std::span<const Index> roi, const Constraints& constraints,
                  const SystemPattern& pattern, const EnergyTerms& terms, StageTimings& timings);

  /// The same, to be prepared step by step: `assemble` and `analyze` (in any order, or beside each
  /// other), then `factor`. The steps may be repeated when positions, weights or constraints have
  /// changed.
  LaplacianSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                  const SystemPattern& pattern);

  /// Takes symbolic factorization, weights and rings over from a system of the same unknowns.
  void begin_like(const LaplacianSystem& other);

  /// L and L'Om L + K, for which neither order nor constraints are needed. `rest` must stay where
  /// it is until the rings are first asked for.
  void assemble(std::span<const Eigen::Vector3d> rest, const EnergyTerms& terms,
                std::span<const Spring> springs = {});
  /// The same with known weights. If they are those of the last time, so is `rest`, and the rings
  /// are kept.
  void assemble(std::span<const Eigen::Vector3d> rest, std::shared_ptr<const EnergyWeights> weights,
                std::span<const Spring> springs);
  bool is_assembled() const { return is_assembled_; }
  /// As last assembled.
  const EnergyWeights& weights() const { return *weights_; }
  /// The same, which stay what they are when others are assembled.
  const std::shared_ptr<const EnergyWeights>& shared_weights() const { return weights_; }
  /// Likewise, none kStiff any more.
  std::span<const Spring> springs() const { return springs_; }
  /// L'Om L + K, without W.
  BlockMatrix unconstrained_matrix() const { return factor_.unconstrained_matrix(); }
  /// (L'Om L + K) u over the unknowns, u given for the whole mesh and 0 outside the region: 3
  /// numbers per unknown.
  void multiply(std::span<const Eigen::Vector3d> u, std::span<double> y) const;
  /// Order and symbolic factorization, for which the pattern is enough. Does nothing the second
  /// time.
  void analyze();
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// The factor under `W`, one number per unknown; redoes what has changed since the last time.
  /// Throws SolverError as above; all but the factor is kept then.
  void factor(std::span<const double> W);
  /// Whether the system is factored under `W`.
  bool holds(std::span<const double> W) const { return is_assembled_ && factor_.holds(W); }

  /// Unknowns and their rows come in the order of elimination, so that neighbours in space are
  /// neighbours in memory: unknown k of these is unknown `elimination_order()[k]`. Built by the
  /// first call, after the system has been analyzed.
  const RegionRings& rings() const { return *shared_rings(); }
  /// The same, which stay what they are when others are made.
  std::shared_ptr<const RegionRings> shared_rings() const;
  const std::vector<int>& elimination_order() const { return pattern_.order(); }
  const Constraints& constraints() const { return constraints_; }
  std::string_view solver_name() const { return factor_.solver().name(); }
  /// Memory of the factorization, known once analyzed.
  std::size_t factor_bytes() const { return factor_.solver().statistics().peak_bytes; }
  std::size_t size() const { return constraints_.unknowns.size(); }

  /// b = W d - (L'Om L + K) d', d what `wanted` (one vector for each vertex of the mesh) says for
  /// unknowns that are held, d' for vertices of the region whose motion is given. x of all
  /// unknowns, then y, then z.
  void right_hand_side(std::span<const Eigen::Vector3d> wanted, std::span<double> b) const;

  /// b += what the springs pull by, in that order.
  void add_spring_forces(std::span<double> b) const;

  /// Replaces `columns` right-hand sides of `size()` numbers, one after the other, by their
  /// solutions. Allocates nothing from the second call on. May be called from several threads,
  /// which wait for each other.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;
  /// As `solve_in_place`, the unknowns in the order of elimination.
  void solve_in_elimination_order(std::span<double> columns_of_b, std::size_t columns) const;

 private:
  std::vector<Index> rows_by_elimination() const;
  void add_edge_terms(BlockMatrix& A) const;

  const Topology& topology_;
  const SystemPattern& pattern_;
  VertexSet roi_;
  Constraints constraints_;
  std::vector<char> is_row_;  ///< per vertex of the mesh
  BlockRows L_;               ///< each row times the root of its weight
  std::shared_ptr<const EnergyWeights> weights_ = std::make_shared<const EnergyWeights>();
  std::vector<Spring> springs_;
  bool is_assembled_ = false;
  std::span<const Eigen::Vector3d> rest_;  ///< as assembled last
  mutable std::mutex building_rings_;
  mutable std::shared_ptr<const RegionRings> rings_;  ///< null until they are asked for
  std::vector<Index> places_;  ///< unknown -> where it stands in the order of elimination
  ConstrainedFactor factor_;
};

}  // namespace lapwing
