#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/elastic/coarse_surfaces.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/response_system.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// Thrown if the 3n x 3n system of a region exceeds the memory limit.
class DoesNotFit : public SolverError {
 public:
  explicit DoesNotFit(const std::string& need)
      : SolverError(need + "; choose a smaller region, or turn on \"settle\""), need_(need) {}
  /// The required and the allowed memory, as text.
  const std::string& need() const { return need_; }

 private:
  std::string need_;
};

/// The inputs that determine the values of a system, except region and constraints.
struct SystemTerms {
  std::shared_ptr<const Positions> rest;  ///< equal positions must have the same pointer
  EnergyTerms energy;
  bool turns_freely = false;                           ///< EditRegion::turns_freely
  std::shared_ptr<const std::vector<Spring>> springs;  ///< null if there are none

  bool operator==(const SystemTerms&) const = default;
};

/// Caches the factors for edits of one region with the same unknowns. A returned factor never
/// changes. The next factor shares the pattern, orders and symbolic factorizations. It also reuses
/// the memory of the previous factor if nothing else uses that factor. All results are bitwise
/// identical to those of a factorization from scratch. The class is thread-safe.
class FactorCache {
 public:
  /// Computes only the pattern. `topology` must outlive the object.
  FactorCache(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns);

  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  const SystemPattern& pattern() const { return pattern_; }

  /// Builds the n x n system of an edit step by step. Locks the cache until it is destroyed.
  class LaplacianBuild {
   public:
    bool is_ordered() const { return cache_.pattern_.is_ordered(); }
    bool is_analyzed() const { return system_->is_analyzed(); }
    /// Returns the memory of the factorization; call after `analyze`.
    std::size_t factor_bytes() const { return system_->factor_bytes(); }
    /// Assembles L'Om L + K, which does not need the order.
    void assemble();
    /// Finds the order and the symbolic factorization; may run in parallel to `assemble`.
    void analyze() { system_->analyze(); }
    /// Runs the symbolic factorization of the 3n x 3n pattern, for the Hessian of a pose. Does
    /// nothing if the region is large.
    void analyze_hessian();
    /// Factorizes the system. Runs `assemble` and `analyze` first if they have not run. Throws
    /// SolverError if no constraint holds a component; the message names a vertex.
    std::shared_ptr<const LaplacianSystem> finish();

   private:
    friend class FactorCache;
    LaplacianBuild(FactorCache& cache, SystemTerms terms, std::span<const double> W);

    FactorCache& cache_;
    std::unique_lock<std::mutex> lock_;
    SystemTerms terms_;
    std::span<const double> W_;
    std::shared_ptr<LaplacianSystem> system_;
  };
  /// `W` contains the squared weight of each unknown and must outlive the LaplacianBuild.
  LaplacianBuild build_laplacian(SystemTerms terms, std::span<const double> W) {
    return {*this, std::move(terms), W};
  }

  /// Returns the factorized 3n x 3n system. `options` determine its kind and its memory limit.
  /// Reports the stages "assemble", "analyze", "normal_matrix" and "factor", except those already
  /// done. Throws DoesNotFit if the memory does not suffice; the cache then contains no part of the
  /// system.
  std::shared_ptr<const ResponseSystem> response(const SystemTerms& terms,
                                                 std::shared_ptr<const LaplacianSystem> laplacian,
                                                 const DeformOptions& options, Kernels& kernels,
                                                 const Progress& progress, StageTimings& timings);

  /// Returns G at rest (`tangent_rows`), from which the Hessian at a pose is assembled. The
  /// response and all callers share it.
  std::shared_ptr<const BlockRows> tangent_rows(const SystemTerms& terms,
                                                const LaplacianSystem& laplacian, Kernels& kernels);

  CoarseSurfaces& coarse_surfaces() { return coarse_surfaces_; }

 private:
  void require_memory(std::size_t limit_bytes);
  std::shared_ptr<const BlockRows> held_tangent_rows(const SystemTerms& terms) const;

  const Topology& topology_;
  const VertexSet roi_;
  const Unknowns unknowns_;
  const SystemPattern pattern_;
  CoarseSurfaces coarse_surfaces_;

  std::mutex mutex_;  // guards all members below
  std::shared_ptr<LaplacianSystem> laplacian_;
  SystemTerms laplacian_terms_;  // default-constructed if the system is not assembled
  // Of the first 3n x 3n system, computed in advance.
  std::shared_ptr<const SolverAnalysis> analysis_ahead_;
  std::shared_ptr<ResponseSystem> response_;
  LinearResponse response_kind_ = LinearResponse::tangent;
  SystemTerms response_terms_;
  bool response_has_memory_ = false;
  std::size_t response_bytes_ = 0;       // memory that `response_` needs; 0 if unknown
  std::weak_ptr<const BlockRows> rows_;  // G at rest, while it is in use
  SystemTerms rows_terms_;
};

}  // namespace lapwing
