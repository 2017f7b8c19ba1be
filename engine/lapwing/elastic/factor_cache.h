#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/base/progress.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/elastic/coarse_surfaces.h"
#include "lapwing/elastic/deform_options.h"
#include "lapwing/elastic/response_system.h"
#include "lapwing/laplacian/laplacian_system.h"

namespace lapwing {

/// The 3n x 3n system of a region exceeds the memory limit.
class DoesNotFit : public SolverError {
 public:
  explicit DoesNotFit(const std::string& need)
      : SolverError(need + "; choose a smaller region, or settle, which can do without"),
        need_(need) {}
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

/// The factors of edits of one region over the same unknowns. A factor that has been handed out
/// does not change. The next one shares pattern, orders and symbolic factorizations with it, and if
/// nobody holds it any more also its memory and the parts that have not changed. Results have the
/// bits of a factorization from scratch. All members may be called from several threads.
class FactorCache {
 public:
  /// Finds the pattern, and nothing else yet. `topology` must outlive the object.
  FactorCache(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns);

  bool serves(const VertexSet& roi, const Unknowns& unknowns) const;
  const SystemPattern& pattern() const { return pattern_; }

  /// Makes the n x n system of an edit step by step. Holds the cache until it is destroyed.
  class LaplacianBuild {
   public:
    bool is_ordered() const { return cache_.pattern_.is_ordered(); }
    bool is_analyzed() const { return system_->is_analyzed(); }
    /// Memory of the factorization, known once analyzed.
    std::size_t factor_bytes() const { return system_->factor_bytes(); }
    /// L'Om L + K, for which the order is not needed.
    void assemble();
    /// The order and the symbolic factorization; may run beside `assemble`.
    void analyze() { system_->analyze(); }
    /// The symbolic factorization of the 3n x 3n pattern, which the Hessian of a pose needs, unless
    /// the region is large.
    void analyze_hessian();
    /// Factors, after what has not been done of the above. Throws SolverError, naming the vertex,
    /// if a component is not held.
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
  /// `W` holds the squared weight of each unknown and must outlive the build.
  LaplacianBuild build_laplacian(SystemTerms terms, std::span<const double> W) {
    return {*this, std::move(terms), W};
  }

  /// The factored 3n x 3n system. `options` give its kind and memory limit; `laplacian` is the
  /// edit's n x n system. Reports the stages "assemble", "analyze", "normal_matrix" and "factor",
  /// those that are not done yet. Throws DoesNotFit, for a large region before its memory is taken,
  /// and keeps nothing of the system then.
  std::shared_ptr<const ResponseSystem> response(const SystemTerms& terms,
                                                 std::shared_ptr<const LaplacianSystem> laplacian,
                                                 const DeformOptions& options, Kernels& kernels,
                                                 const Progress& progress, StageTimings& timings);

  /// G at rest (`tangent_rows`), from which the Hessian of a pose is made; one for all who hold it,
  /// the response included.
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

  std::mutex mutex_;  // guards all below
  std::shared_ptr<LaplacianSystem> laplacian_;
  SystemTerms laplacian_terms_;  // without positions if it is not assembled
  std::shared_ptr<const SolverAnalysis> analysis_ahead_;  // of the 3n x 3n system that comes first
  std::shared_ptr<ResponseSystem> response_;
  LinearResponse response_kind_ = LinearResponse::tangent;
  SystemTerms response_terms_;
  bool response_has_memory_ = false;
  std::size_t response_bytes_ = 0;       // that it needs, once known
  std::weak_ptr<const BlockRows> rows_;  // G at rest, while somebody holds it
  SystemTerms rows_terms_;
};

}  // namespace lapwing
