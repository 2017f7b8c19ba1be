#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/deform/coarse_surfaces.h"
#include "lapwing/deform/deform_options.h"
#include "lapwing/deform/response_system.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// The 3n x 3n system of a region needs more memory than it may take.
class DoesNotFit : public SolverError {
 public:
  explicit DoesNotFit(std::string need)
      : SolverError(need + "; choose a smaller region, or settle, which can do without"),
        need_(std::move(need)) {}
  /// What it needs and may take, in words.
  const std::string& need() const { return need_; }

 private:
  std::string need_;
};

/// What the numbers of a system depend on besides region and constraints.
struct SystemTerms {
  std::shared_ptr<const Positions> rest;  ///< the same pointer for the same positions
  EnergyTerms energy;
  bool turns_freely = false;                           ///< EditRegion::turns_freely
  std::shared_ptr<const std::vector<Spring>> springs;  ///< null for none

  bool operator==(const SystemTerms&) const = default;
};

/// The systems of all edits with one ROI and the same unknowns, each as one of these edits left it:
/// whoever uses one makes it that of its own edit by `hold_...` first, which does nothing where it
/// is, and keeps the lock from then on.
class RegionSystem {
 public:
  /// Finds the pattern, and nothing else yet.
  RegionSystem(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns);
  /// For edits at the same time as those of this one, whose pattern and order, once it is ordered,
  /// the other one shares.
  std::shared_ptr<RegionSystem> beside() const;

  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;

  [[nodiscard]] std::unique_lock<std::mutex> lock() { return std::unique_lock(mutex_); }

  /// L and L'Om L + K, for which neither order nor constraints are needed.
  void assemble_laplacian(const SystemTerms& terms);
  /// The order; once.
  void find_order() { pattern_->order(); }
  const SystemPattern& pattern() const { return *pattern_; }
  bool is_ordered() const { return pattern_->is_ordered(); }
  /// The order and the symbolic factorization of the n x n system; once. May run beside
  /// `assemble_laplacian`.
  void analyze_laplacian() { laplacian_.analyze(); }
  /// That and the symbolic factorization of the 3n x 3n system, one beside the other; of a region
  /// whose 3n x 3n system may not fit the first alone.
  void analyze_both();
  /// Both, and the factor under `W`.
  void hold_laplacian(const SystemTerms& terms, std::span<const double> W);
  /// As held last; `with_rings` has its rings too.
  const LaplacianSystem& laplacian() const { return laplacian_; }
  const LaplacianSystem& laplacian_with_rings();

  /// The 3n x 3n system under `W`, of the kind, by the solver and within the memory that `options`
  /// say; stages "assemble", "analyze", "normal_matrix" and "factor" as far as they are to be done.
  /// The n x n one is assembled for it. Throws DoesNotFit, of a large region before its memory is
  /// taken, and keeps nothing of the system then.
  void hold_response(const SystemTerms& terms, std::span<const double> W,
                     const DeformOptions& options, Kernels& kernels, const Progress& progress,
                     StageTimings& timings);
  /// As held last.
  const ResponseSystem& response() const { return *response_; }
  /// G at rest, of which settling makes the tangent of a pose; one for all who hold it, the
  /// response among them. The n x n system is assembled for it.
  std::shared_ptr<const BlockRows> tangent_rows(const SystemTerms& terms, Kernels& kernels);

  /// Without the lock.
  CoarseSurfaces& coarse_surfaces() { return coarse_surfaces_; }

 private:
  RegionSystem(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns,
               std::shared_ptr<const SystemPattern> pattern);
  void require_memory(std::size_t limit_bytes);
  std::shared_ptr<const BlockRows> held_tangent_rows(const SystemTerms& terms) const;

  const Topology& topology_;
  const VertexSet roi_;
  const Unknowns unknowns_;
  const std::shared_ptr<const SystemPattern> pattern_;
  std::mutex mutex_;
  LaplacianSystem laplacian_;
  SystemTerms laplacian_terms_;  ///< no positions where it is not assembled
  /// For whoever factors a 3n x 3n system first; null where it was not made ahead.
  std::shared_ptr<const SolverAnalysis> analysis_ahead_;
  std::unique_ptr<ResponseSystem> response_;
  LinearResponse response_kind_ = LinearResponse::tangent;
  SystemTerms response_terms_;
  std::weak_ptr<const BlockRows> rows_;  ///< G at rest, where somebody holds it
  SystemTerms rows_terms_;
  bool response_has_memory_ = false;
  std::size_t response_bytes_ = 0;  ///< that it needs, once known
  CoarseSurfaces coarse_surfaces_;
};

}  // namespace lapwing
