#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/held_factor.h"

namespace lapwing {

/// The factored RSI system of one region. Soft constraints: (M'M + W) u = W d over the region's
/// vertices. Hard ones: M'M u = -M'M d over the free vertices, d given on handle and belt.
class RsiSolution {
 public:
  /// Of the region's rows over `unknowns`, not ready yet. `topology` and `pattern` must outlive the
  /// object.
  RsiSolution(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
              const SystemPattern& pattern, SolverKind solver);

  /// The symbolic factorization; once. Stage "analyze".
  void analyze(const Progress& progress, StageTimings& timings);
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Once analyzed: the memory that matrices and factor take at most. What a solver other than ours
  /// takes is not known, and left out.
  std::size_t memory_bytes() const;

  /// M and M'M, with `weights` per ring entry; beside it the symbolic factorization where that is
  /// still to be done. Stages "assemble", "analyze" (what was left of that) and
  /// "normal_matrix".
  void assemble(std::span<const Eigen::Vector3d> rest, std::span<const double> weights,
                Kernels& kernels, const Progress& progress, StageTimings& timings);

  /// The factor under `W`, one number per unknown, after `assemble`; redoes what has changed since
  /// the last time. Stage "factor". Throws SolverError, naming the vertex and its component, when
  /// the system is singular, and Cancelled: all but the factor is kept then.
  void factor(std::span<const double> W, const Progress& progress, StageTimings& timings);

  std::string_view solver_name() const { return factor_.solver().name(); }

  /// The right-hand side for wanted displacements of the whole mesh (given on handles, 0
  /// elsewhere): 3 numbers per unknown.
  void right_hand_side(std::span<const Eigen::Vector3d> wanted, std::span<double> b) const;

  /// Replaces `columns` right-hand sides, one after the other, by their solutions.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;

  /// Improves `u` (displacements of the whole mesh) by iterative refinement while the residual is
  /// larger than rounding leaves it; returns the relative residual, 0 when nothing is wanted.
  double refine(std::span<const Eigen::Vector3d> wanted, std::vector<Eigen::Vector3d>& u) const;

 private:
  void residual(std::span<const Eigen::Vector3d> wanted, std::span<const Eigen::Vector3d> u,
                std::span<double> r) const;

  const Topology& topology_;
  const SystemPattern& pattern_;
  std::vector<Index> roi_;
  Constraints constraints_;
  BlockRows M_;
  HeldFactor factor_;
};

}  // namespace lapwing
