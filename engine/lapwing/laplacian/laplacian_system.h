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

/// The factorized n x n system (L'Om L + K + W) u = b of one region, which is the same for x, y and
/// z (ENERGY.md sections 3 and 4). Om is the diagonal matrix of the row weights. K is the matrix of
/// the springs and of the edge energy sum_ij k_ij |u_i - u_j|^2, in which each row counts the edges
/// of its ring (EnergyWeights). Without a detail length, Om is the identity and K has no edge
/// energy.
class LaplacianSystem {
 public:
  /// Assembles and factorizes the system; records the stage "laplacian". `topology` and `pattern`
  /// must outlive the object. Throws SolverError if no constraint holds a component; the message
  /// names a vertex.
  LaplacianSystem(std::span<const Eigen::Vector3d> rest, const Topology& topology,
                  std::span<const Index> roi, const Constraints& constraints,
                  const SystemPattern& pattern, const EnergyTerms& terms, StageTimings& timings);

  /// Creates a system that is prepared in steps: call `assemble` and `analyze` in any order or in
  /// parallel, then `factorize`. Repeat a step after positions, weights or constraints have
  /// changed.
  LaplacianSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                  const SystemPattern& pattern);

  /// Shares the symbolic factorization, weights and rings of a system with the same unknowns.
  void share_setup_from(const LaplacianSystem& other);

  /// Assembles L and L'Om L + K, which need neither order nor constraints. `rest` must stay valid
  /// until `rings` is first called.
  void assemble(std::span<const Eigen::Vector3d> rest, const EnergyTerms& terms,
                std::span<const Spring> springs = {});
  /// Like `assemble` above, with given weights. If `weights` is the same object as in the last
  /// call, the rings are reused, and `rest` must also be the same.
  void assemble(std::span<const Eigen::Vector3d> rest, std::shared_ptr<const EnergyWeights> weights,
                std::span<const Spring> springs);
  bool is_assembled() const { return is_assembled_; }
  /// Returns the weights of the last assembly.
  const EnergyWeights& weights() const { return *weights_; }
  /// Returns the weights of the last assembly as an object that later assemblies do not change.
  const std::shared_ptr<const EnergyWeights>& shared_weights() const { return weights_; }
  /// Returns the springs of the last assembly, with a finite stiffness instead of kStiff.
  std::span<const Spring> springs() const { return springs_; }
  /// Returns L'Om L + K, without W.
  BlockMatrix unconstrained_matrix() const { return factor_.unconstrained_matrix(); }
  /// Computes y = (L'Om L + K) u over the unknowns, 3 numbers each. `u` has one vector per vertex
  /// of the mesh, 0 outside the region.
  void multiply(std::span<const Eigen::Vector3d> u, std::span<double> y) const;
  /// Computes the order and the symbolic factorization, which need only the pattern. Later calls do
  /// nothing.
  void analyze();
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Factorizes with the stiffness `W`, one number per unknown. Recomputes only the parts that have
  /// changed since the last factorization. Replaces kStiff by 1000 times the matrix's diagonal at
  /// the vertex, or 1000 times the mean diagonal if that is larger; with stiffness factors, the
  /// mean is computed as if all vertices had the smallest factor. Throws SolverError as the
  /// constructor does; only the factor is then lost.
  void factorize(std::span<const double> W);
  /// Returns true if the current factor is that of the matrix with stiffness `W`.
  bool is_factorized_for(std::span<const double> W) const {
    return is_assembled_ && factor_.is_factorized_for(finite_weights(W));
  }

  /// Returns the rings, with unknowns and rows in elimination order, so that neighbouring vertices
  /// are close in memory. Unknown k of the rings is unknown elimination_order()[k] of the system.
  /// The first call computes the rings. Call `analyze` first.
  const RegionRings& rings() const { return *shared_rings(); }
  /// Like `rings`, but later assemblies do not change the returned object.
  std::shared_ptr<const RegionRings> shared_rings() const;
  const std::vector<int>& elimination_order() const { return pattern_.order(); }
  const Constraints& constraints() const { return constraints_; }
  std::string_view solver_name() const { return factor_.solver().name(); }
  /// Returns the memory of the factorization, which is known after `analyze`.
  std::size_t factor_bytes() const { return factor_.solver().statistics().peak_bytes; }
  std::size_t size() const { return constraints_.unknowns.size(); }

  /// Computes b = W d - (L'Om L + K) d', ordered as x of all unknowns, then y, then z. `prescribed`
  /// has one vector per vertex of the mesh. d are the prescribed vectors of the constrained
  /// unknowns, d' those of the region's vertices that are not unknowns.
  void right_hand_side(std::span<const Eigen::Vector3d> prescribed, std::span<double> b) const;

  /// Adds the forces of the springs to b, in the order of `right_hand_side`.
  void add_spring_forces(std::span<double> b) const;

  /// Replaces `columns` right-hand sides of `size()` numbers, which are stored one after the other,
  /// by their solutions. Only the first call allocates memory. May be called from several threads,
  /// which wait for each other.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;
  /// Like `solve_in_place`, with the unknowns in elimination order.
  void solve_in_elimination_order(std::span<double> columns_of_b, std::size_t columns) const;

 private:
  double mean_diagonal() const;
  std::vector<double> finite_weights(std::span<const double> W) const;
  std::vector<Index> rows_by_elimination() const;
  void add_edge_terms(BlockMatrix& A) const;

  const Topology& topology_;
  const SystemPattern& pattern_;
  VertexSet roi_;
  Constraints constraints_;
  std::vector<char> is_row_;  ///< per vertex of the mesh
  BlockRows L_;               ///< rows of L, each multiplied by the square root of its weight
  std::shared_ptr<const EnergyWeights> weights_ = std::make_shared<const EnergyWeights>();
  std::vector<Spring> springs_;
  bool is_assembled_ = false;
  std::span<const Eigen::Vector3d> rest_;  ///< positions of the last assembly
  mutable std::mutex building_rings_;
  /// Null until the first call of `shared_rings`.
  mutable std::shared_ptr<const RegionRings> rings_;
  std::vector<Index> places_;  ///< position of each unknown in the elimination order
  ConstrainedFactor factor_;
};

}  // namespace lapwing
