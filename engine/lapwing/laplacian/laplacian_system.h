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
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/region_rings.h"
#include "lapwing/laplacian/springs.h"
#include "lapwing/laplacian/system_pattern.h"

namespace lapwing {

/// The factored n x n system (L'Om L + K + W) u = b of one region, the same for x, y and z
/// (ENERGY.md sections 3 and 4). Om holds the weights of the rows. K is the matrix of the springs
/// and of the edge energy sum_ij k_ij |u_i - u_j|^2, in which each row counts the edges of its ring
/// (EnergyWeights). Without a detail length, Om is the identity and K has no edge energy.
class LaplacianSystem {
 public:
  /// Assembles and factorizes; stage "laplacian". `topology` and `pattern` must outlive the object.
  /// Throws SolverError with the vertex if a component is not held.
  LaplacianSystem(std::span<const Eigen::Vector3d> rest, const Topology& topology,
                  std::span<const Index> roi, const Constraints& constraints,
                  const SystemPattern& pattern, const EnergyTerms& terms, StageTimings& timings);

  /// The same, prepared in steps: `assemble` and `analyze` in any order or in parallel, then
  /// `factor`. Repeat a step after positions, weights or constraints have changed.
  LaplacianSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                  const SystemPattern& pattern);

  /// Takes over the symbolic factorization, weights and rings of a system with the same unknowns.
  void share_setup_from(const LaplacianSystem& other);

  /// Assembles L and L'Om L + K, which need neither order nor constraints. `rest` must stay valid
  /// until `rings` is first called.
  void assemble(std::span<const Eigen::Vector3d> rest, const EnergyTerms& terms,
                std::span<const Spring> springs = {});
  /// Uses given weights. If `weights` is the same object as in the last call, `rest` must be the
  /// same too, and the rings are reused.
  void assemble(std::span<const Eigen::Vector3d> rest, std::shared_ptr<const EnergyWeights> weights,
                std::span<const Spring> springs);
  bool is_assembled() const { return is_assembled_; }
  /// The weights as last assembled.
  const EnergyWeights& weights() const { return *weights_; }
  /// The same, unchanged by later assemblies.
  const std::shared_ptr<const EnergyWeights>& shared_weights() const { return weights_; }
  /// The springs as last assembled, with a finite stiffness instead of kStiff.
  std::span<const Spring> springs() const { return springs_; }
  /// Returns L'Om L + K, without W.
  BlockMatrix unconstrained_matrix() const { return factor_.unconstrained_matrix(); }
  /// Computes y = (L'Om L + K) u over the unknowns, 3 numbers each. `u` has one vector per vertex
  /// of the mesh, 0 outside the region.
  void multiply(std::span<const Eigen::Vector3d> u, std::span<double> y) const;
  /// Computes order and symbolic factorization, which need only the pattern. Does nothing the
  /// second time.
  void analyze();
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Factorizes with `W`, one number per unknown, and recomputes only what has changed since the
  /// last factorization. Replaces kStiff by 1000 times the diagonal of the matrix at the vertex, or
  /// 1000 times the mean diagonal if that is larger. Throws SolverError as above; then only the
  /// factor is lost.
  void factorize(std::span<const double> W);
  /// Returns true if the system is factored with `W`.
  bool is_factorized_for(std::span<const double> W) const {
    return is_assembled_ && factor_.is_factorized_for(finite_weights(W));
  }

  /// Returns the rings, with unknowns and rows in the order of elimination, so that neighbours in
  /// space are neighbours in memory: unknown k of the rings is unknown `elimination_order()[k]`.
  /// The first call builds them. Call `analyze` first.
  const RegionRings& rings() const { return *shared_rings(); }
  /// The same, unchanged when others are built.
  std::shared_ptr<const RegionRings> shared_rings() const;
  const std::vector<int>& elimination_order() const { return pattern_.order(); }
  const Constraints& constraints() const { return constraints_; }
  std::string_view solver_name() const { return factor_.solver().name(); }
  /// Returns the memory of the factorization, which is known after `analyze`.
  std::size_t factor_bytes() const { return factor_.solver().statistics().peak_bytes; }
  std::size_t size() const { return constraints_.unknowns.size(); }

  /// Computes b = W d - (L'Om L + K) d', ordered as x of all unknowns, then y, then z. `prescribed`
  /// has one vector per vertex of the mesh. d holds its values at the constrained unknowns, and d'
  /// its values at the vertices of the region that are not unknowns.
  void right_hand_side(std::span<const Eigen::Vector3d> prescribed, std::span<double> b) const;

  /// Adds the forces of the springs to b, in that order.
  void add_spring_forces(std::span<double> b) const;

  /// Replaces `columns` right-hand sides of `size()` numbers, one after the other, by their
  /// solutions. Allocates nothing from the second call on. May be called from several threads,
  /// which wait for each other.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;
  /// Like `solve_in_place`, with the unknowns in the order of elimination.
  void solve_in_elimination_order(std::span<double> columns_of_b, std::size_t columns) const;

 private:
  std::vector<double> finite_weights(std::span<const double> W) const;
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
  mutable std::shared_ptr<const RegionRings> rings_;  ///< null until first used
  std::vector<Index> places_;  ///< unknown -> its place in the order of elimination
  ConstrainedFactor factor_;
};

}  // namespace lapwing
