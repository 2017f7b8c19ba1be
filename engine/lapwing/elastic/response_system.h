#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/constrained_factor.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// Returns A x I - G'G. The diagonal is slightly enlarged, so that rounding errors do not make the
/// matrix indefinite. `memory` is reused, as in NormalPattern::reduced_matrix.
BlockMatrix energy_hessian(const SystemPattern& pattern, const LaplacianSystem& laplacian,
                           const BlockRows& G, Numbers memory = {});

/// Returns the rows of G at rest (ENERGY.md section 5) for the vertices `roi`.
std::shared_ptr<BlockRows> tangent_rows(const Topology& topology, std::span<const Index> roi,
                                        const LaplacianSystem& laplacian,
                                        std::span<const Eigen::Vector3d> rest, Kernels& kernels);

/// The factorized 3n x 3n system from which the linear response of a region is computed. Its matrix
/// N is the energy's tangent at rest, (L'Om L + K) x I - G'G (ENERGY.md section 5), or the paper's
/// M'M. With soft constraints, it solves (N + W) u = W d + f over the region's vertices, where f
/// are forces on them. With hard constraints, it solves N u = f - N d over the free vertices, where
/// d is prescribed on handles and belt.
class ResponseSystem {
 public:
  /// Does not compute anything. The rows of the system belong to `roi`, its columns to `unknowns`.
  /// `topology` and `pattern` must outlive the object.
  ResponseSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                 const SystemPattern& pattern, LinearResponse kind);

  /// Sets the n x n system of the edit, with its weights and springs. Call this before all
  /// functions below.
  void set_laplacian(std::shared_ptr<const LaplacianSystem> laplacian) {
    laplacian_ = std::move(laplacian);
  }

  /// Runs the symbolic factorization, unless an earlier call has. Records the stage "analyze".
  void analyze(const Progress& progress, StageTimings& timings);
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Returns the peak memory of matrices and factor, after `analyze`. Does not include the memory
  /// of external solvers, which is unknown.
  std::size_t memory_bytes() const;

  /// Assembles the rows and N with the weights of the n x n system. Calls `analyze` if no earlier
  /// call has. If `turns_freely` is true, adds a small multiple of A to the tangent, so that
  /// components that can rotate about a line rotate as little as possible. `rows` is the result of
  /// tangent_rows, or null if it has not been computed. Records the stages "assemble", "analyze"
  /// and "normal_matrix".
  void assemble(std::span<const Eigen::Vector3d> rest, bool turns_freely,
                std::shared_ptr<const BlockRows> rows, Kernels& kernels, const Progress& progress,
                StageTimings& timings);

  /// Factorizes N + W, where `W` has one number per unknown. Recomputes only the parts that have
  /// changed. Records the stage "factor". Throws Cancelled. Throws SolverError if the system is
  /// singular; the message names the vertex and its component. After an exception, only the factor
  /// is lost.
  void factorize(std::span<const double> W, const Progress& progress, StageTimings& timings);
  /// Returns true if the current factor is that of N + W.
  bool is_factorized_for(std::span<const double> W) const { return factor_.is_factorized_for(W); }

  std::string_view solver_name() const { return factor_.solver().name(); }

  /// Returns G or M of the last assembly. The returned rows never change.
  std::shared_ptr<const BlockRows> rows() const { return rows_; }

  /// Writes the right-hand side W d - N d', 3 numbers per unknown. `prescribed` has one vector per
  /// vertex of the mesh, which is 0 outside the handles. d are the prescribed vectors of the
  /// unknowns, d' those of the other vertices of the region.
  void right_hand_side(std::span<const Eigen::Vector3d> prescribed, std::span<double> b) const;

  /// Replaces `columns` right-hand sides, which are stored one after the other, by their solutions.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;

  /// Improves `u` (displacements of the whole mesh) by iterative refinement until the residual is
  /// near rounding error, at most twice. Returns the relative residual, or 0 if the right-hand side
  /// is 0. `forces` is f; if empty, no forces act.
  double refine(std::span<const Eigen::Vector3d> prescribed, std::span<const double> forces,
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
