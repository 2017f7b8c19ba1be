#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/edit_system.h"
#include "lapwing/kernels/kernels.h"

namespace lapwing {

/// The factored RSI system of one region. Soft constraints: (M'M + W) u = W d over the region's
/// vertices. Hard ones: M'M u = -M'M d over the free vertices, d given on handle and belt.
class RsiSolution {
 public:
  /// Assembles with `weights` and factors; stages "assemble", "normal_matrix", "analyze" and
  /// "factor". `system` must outlive the object. Throws SolverError, naming the vertex and its
  /// component, when the system is singular.
  RsiSolution(const EditSystem& system, std::span<const double> weights, Kernels& kernels,
              const Progress& progress, StageTimings& timings);

  std::string_view solver_name() const { return solver_->name(); }

  /// The right-hand side for wanted displacements of the whole mesh (given on handles, 0
  /// elsewhere): 3 numbers per unknown.
  void right_hand_side(std::span<const Eigen::Vector3d> wanted, std::span<double> b) const;

  /// Replaces `columns` right-hand sides, one after the other, by their solutions.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;

  /// Improves `u` (displacements of the whole mesh) by iterative refinement while the residual is
  /// larger than rounding leaves it; returns the relative residual, 0 when nothing is wanted.
  double refine(std::span<const Eigen::Vector3d> wanted, std::vector<Eigen::Vector3d>& u) const;

 private:
  void factor(const BlockMatrix& N, const Topology& topology, const Progress& progress);
  void residual(std::span<const Eigen::Vector3d> wanted, std::span<const Eigen::Vector3d> u,
                std::span<double> r) const;

  const Constraints& constraints_;
  const SystemPattern& pattern_;
  BlockRows M_;
  std::unique_ptr<BlockSolver> solver_;
};

}  // namespace lapwing
