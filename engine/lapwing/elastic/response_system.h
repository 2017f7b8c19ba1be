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

/// Returns A x I - G'G, with a slightly enlarged diagonal against rounding. `memory` as in
/// NormalPattern::reduced_matrix.
BlockMatrix energy_hessian(const SystemPattern& pattern, const LaplacianSystem& laplacian,
                           const BlockRows& G, Numbers memory = {});

/// Returns G at rest, over the region's rows.
std::shared_ptr<BlockRows> tangent_rows(const Topology& topology, std::span<const Index> roi,
                                        const LaplacianSystem& laplacian,
                                        std::span<const Eigen::Vector3d> rest, Kernels& kernels);

/// The factored 3n x 3n system N of one region from which drags take their response: the energy's
/// tangent at rest, (L'Om L + K) x I - G'G (ENERGY.md section 5), or the paper's M'M. Soft
/// constraints: (N + W) u = W d + f over the region's vertices, f forces on them. Hard ones:
/// N u = f - N d over the free vertices, d given on handle and belt.
class ResponseSystem {
 public:
  /// Prepares nothing yet. The system has the region's rows over `unknowns`. `topology` and
  /// `pattern` must outlive the object.
  ResponseSystem(const Topology& topology, std::span<const Index> roi, const Unknowns& unknowns,
                 const SystemPattern& pattern, LinearResponse kind);

  /// Sets the edit's n x n system with its weights and springs. Call before everything below.
  void set_laplacian(std::shared_ptr<const LaplacianSystem> laplacian) {
    laplacian_ = std::move(laplacian);
  }

  /// Runs the symbolic factorization; call once. Stage "analyze".
  void analyze(const Progress& progress, StageTimings& timings);
  bool is_analyzed() const { return factor_.is_analyzed(); }
  /// Returns the peak memory of matrices and factor, after `analyze`. Does not include the memory
  /// of an external solver, which is not known.
  std::size_t memory_bytes() const;

  /// Assembles the rows and N with the weights of the n x n system. Analyzes the pattern if no
  /// earlier call has. If `turns_freely`, adds a small multiple of A to the tangent, so that
  /// components that may turn about a line turn as little as possible. `rows` are those of
  /// tangent_rows, or null if they have not been computed. Records the stages "assemble", "analyze"
  /// and "normal_matrix".
  void assemble(std::span<const Eigen::Vector3d> rest, bool turns_freely,
                std::shared_ptr<const BlockRows> rows, Kernels& kernels, const Progress& progress,
                StageTimings& timings);

  /// Factorizes with `W`, one number per unknown, and recomputes only what has changed. Records the
  /// stage "factor". Throws Cancelled. Throws SolverError if the system is singular; the message
  /// names the vertex and its component. After either error, only the factor is lost.
  void factorize(std::span<const double> W, const Progress& progress, StageTimings& timings);
  /// Returns true if the system is factored with `W`.
  bool is_factorized_for(std::span<const double> W) const { return factor_.is_factorized_for(W); }

  std::string_view solver_name() const { return factor_.solver().name(); }

  /// Returns G or M of the last assembly; does not change.
  std::shared_ptr<const BlockRows> rows() const { return rows_; }

  /// Writes the right-hand side W d - N d', 3 numbers per unknown. `prescribed` has one vector per
  /// vertex of the mesh, which is 0 outside the handles. d holds its values at the unknowns, and d'
  /// its values at the other vertices of the region.
  void right_hand_side(std::span<const Eigen::Vector3d> prescribed, std::span<double> b) const;

  /// Replaces `columns` right-hand sides, one after the other, by their solutions.
  void solve_in_place(std::span<double> columns_of_b, std::size_t columns) const;

  /// Improves `u` (displacements of the whole mesh) by iterative refinement while the residual is
  /// above rounding. Returns the relative residual, 0 if nothing is prescribed. `forces` are f, or
  /// empty for none.
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
