#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/constrained_factor.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// A x I - G'G, and as much on the diagonal as rounding may take from it. `memory` as in
/// NormalPattern::reduced_matrix.
BlockMatrix energy_hessian(const SystemPattern& pattern, const LaplacianSystem& laplacian,
                           const BlockRows& G, Numbers memory = {});

/// G at rest, over the region's rows.
std::shared_ptr<BlockRows> tangent_rows(const Topology& topology, std::span<const Index> roi,
                                        const LaplacianSystem& laplacian,
                                        std::span<const Eigen::Vector3d> rest, Kernels& kernels);

/// The factored 3n x 3n system N of one region from which drags take their response: the energy's
/// tangent at rest, (L'Om L + K) x I - G'G (ENERGY.md section 5), or the paper's M'M. Soft
/// constraints: (N + W) u = W d + f over the region's vertices, f forces on them. Hard ones:
/// N u = f - N d over the free vertices, d given on handle and belt.
class ResponseSystem {
 public:
  /// Of the region's rows over `unknowns`, not ready yet. `topology` and `pattern` must outlive the
  /// object.
  ResponseSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                 const SystemPattern& pattern, LinearResponse kind);

  /// Sets the edit's n x n system, whose weights and springs count; before all below.
  void set_laplacian(std::shared_ptr<const LaplacianSystem> laplacian) {
    laplacian_ = std::move(laplacian);
  }

  /// The symbolic factorization; once. Stage "analyze".
  void analyze(const Progress& progress, StageTimings& timings);
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Once analyzed: the memory that matrices and factor take at most. What a solver other than ours
  /// takes is not known, and left out.
  std::size_t memory_bytes() const;

  /// The rows and N, with the weights of the n x n system. Runs the symbolic factorization in
  /// parallel, if it is not done yet. A tangent that `turns_freely` has components that may turn
  /// about a line: a little of A stays in it, so that they turn as little as they can. `rows` are
  /// those of tangent_rows if they are known, else null. Stages "assemble", "analyze" and
  /// "normal_matrix".
  void assemble(std::span<const Eigen::Vector3d> rest, bool turns_freely,
                std::shared_ptr<const BlockRows> rows, Kernels& kernels, const Progress& progress,
                StageTimings& timings);

  /// The factor under `W`, one number per unknown, after `assemble`; redoes what has changed since
  /// the last time. Stage "factor". Throws SolverError, naming the vertex and its component, when
  /// the system is singular, and Cancelled: all but the factor is kept then.
  void factor(std::span<const double> W, const Progress& progress, StageTimings& timings);
  /// Whether the system is factored under `W`.
  bool holds(std::span<const double> W) const { return factor_.holds(W); }

  std::string_view solver_name() const { return factor_.solver().name(); }

  /// G, or M, as assembled last; does not change.
  std::shared_ptr<const BlockRows> rows() const { return rows_; }

  /// The right-hand side W d - N d', d what `wanted` says for unknowns, d' for the others of the
  /// region (of the whole mesh, given on handles, 0 elsewhere): 3 numbers per unknown.
  void right_hand_side(std::span<const Eigen::Vector3d> wanted, std::span<double> b) const;

  /// Replaces `columns` right-hand sides, one after the other, by their solutions.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;

  /// Improves `u` (displacements of the whole mesh) by iterative refinement while the residual is
  /// larger than rounding leaves it; returns the relative residual, 0 when nothing is wanted.
  /// `forces` are f, or empty for none.
  double refine(std::span<const Eigen::Vector3d> wanted, std::span<const double> forces,
                std::vector<Eigen::Vector3d>& u) const;

 private:
  std::shared_ptr<const BlockRows> made_rows(std::span<const Eigen::Vector3d> rest,
                                             bool turns_freely,
                                             std::shared_ptr<const BlockRows> rows,
                                             Kernels& kernels) const;
  void multiply(std::span<const Eigen::Vector3d> u, std::span<double> y) const;

  const Topology& topology_;
  const SystemPattern& pattern_;
  std::shared_ptr<const LaplacianSystem> laplacian_;
  LinearResponse kind_;
  std::vector<Index> roi_;
  Constraints constraints_;
  std::shared_ptr<const BlockRows> rows_;
  ConstrainedFactor factor_;
};

}  // namespace lapwing
