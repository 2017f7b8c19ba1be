#include "lapwing/elastic/factor_cache.h"

#include <string>
#include <utility>

#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

// Returns true if only the cache owns `factor`, so that its memory may be reused.
template <typename T>
bool is_unused(const std::shared_ptr<T>& factor) {
  // Copying modifies the reference count, which synchronizes this thread with the last other
  // owner's release. Reading the count would not.
  const std::shared_ptr<T> copy = factor;
  return copy.use_count() == 2;
}

}  // namespace

FactorCache::FactorCache(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns)
    : topology_(topology), roi_(roi), unknowns_(unknowns), pattern_(topology, roi, unknowns) {}

bool FactorCache::serves(const VertexSet& roi, const Unknowns& unknowns) const {
  return roi == roi_ && unknowns.vertices == unknowns_.vertices;
}

FactorCache::LaplacianBuild::LaplacianBuild(FactorCache& cache, SystemTerms terms,
                                            std::span<const double> W)
    : cache_(cache), lock_(cache.mutex_), terms_(std::move(terms)), W_(W) {
  std::shared_ptr<LaplacianSystem>& kept = cache.laplacian_;
  if (is_unused(cache.response_)) cache.response_->set_laplacian(nullptr);
  const bool is_same =
      kept != nullptr && terms_ == cache.laplacian_terms_ && kept->is_factorized_for(W);
  if (!is_same && !is_unused(kept)) {
    auto fresh = std::make_shared<LaplacianSystem>(cache.topology_, cache.roi_, cache.unknowns_,
                                                   cache.pattern_);
    if (kept != nullptr) fresh->share_setup_from(*kept);
    kept = std::move(fresh);
  }
  system_ = kept;
}

void FactorCache::LaplacianBuild::assemble() {
  SystemTerms& last = cache_.laplacian_terms_;
  if (terms_ == last && system_->is_assembled()) return;
  const SystemTerms before = std::exchange(last, {});
  const auto springs = terms_.springs ? std::span(*terms_.springs) : std::span<const Spring>();
  const Positions& rest = *terms_.rest;
  if (before.rest == terms_.rest && before.energy == terms_.energy) {
    system_->assemble(rest, system_->shared_weights(), springs);
  } else if (before.rest == terms_.rest &&
             before.energy.detail_length == terms_.energy.detail_length &&
             before.energy.stiffness == terms_.energy.stiffness) {
    system_->assemble(rest,
                      std::make_shared<const EnergyWeights>(
                          with_laplacian(*system_->shared_weights(), cache_.topology_, rest,
                                         cache_.roi_, terms_.energy.weights)),
                      springs);
  } else {
    system_->assemble(rest, terms_.energy, springs);
  }
  last = terms_;
}

void FactorCache::LaplacianBuild::analyze_hessian() {
  const bool is_known = cache_.response_ != nullptr || cache_.response_bytes_ > 0;
  if (is_known || cache_.unknowns_.size() > kMinimumDegreeLimit) return;
  cache_.analysis_ahead_ = cache_.pattern_.analysis();
}

std::shared_ptr<const LaplacianSystem> FactorCache::LaplacianBuild::finish() {
  assemble();
  analyze();
  system_->factorize(W_);
  return system_;
}

std::shared_ptr<const ResponseSystem> FactorCache::response(
    const SystemTerms& terms, std::shared_ptr<const LaplacianSystem> laplacian,
    const DeformOptions& options, Kernels& kernels, const Progress& progress,
    StageTimings& timings) {
  const std::unique_lock lock(mutex_);
  const std::vector<double>& W = laplacian->constraints().W;
  if (options.response != response_kind_) {
    response_.reset();
    response_bytes_ = 0;
    response_kind_ = options.response;
  }
  if (response_bytes_ > 0) require_memory(options.memory_limit_bytes);
  const bool is_same =
      response_ != nullptr && terms == response_terms_ && response_->is_factorized_for(W);
  if (is_same) {
    if (is_unused(response_)) response_->set_laplacian(std::move(laplacian));
    return response_;
  }
  if (!is_unused(response_)) {
    response_ =
        std::make_shared<ResponseSystem>(topology_, roi_, unknowns_, pattern_, response_kind_);
    response_terms_ = {};
    response_has_memory_ = false;
  }
  response_->set_laplacian(std::move(laplacian));
  // For smaller regions, the analysis runs in parallel to the assembly, which needs little memory.
  if (unknowns_.size() > kMinimumDegreeLimit) {
    response_->analyze(progress, timings);
    require_memory(options.memory_limit_bytes);
  }
  if (terms != response_terms_) {
    response_terms_ = {};
    response_->assemble(*terms.rest, terms.turns_freely, held_tangent_rows(terms), kernels,
                        progress, timings);
    analysis_ahead_.reset();
    response_terms_ = terms;
  }
  require_memory(options.memory_limit_bytes);
  response_has_memory_ = true;
  response_->factorize(W, progress, timings);
  return response_;
}

// Returns null if the rows are no longer in use. The rows of a response with `turns_freely` are
// different.
std::shared_ptr<const BlockRows> FactorCache::held_tangent_rows(const SystemTerms& terms) const {
  const bool response_has = response_ != nullptr && response_kind_ == LinearResponse::tangent &&
                            terms == response_terms_ && !terms.turns_freely;
  if (response_has) return response_->rows();
  return terms == rows_terms_ ? rows_.lock() : nullptr;
}

std::shared_ptr<const BlockRows> FactorCache::tangent_rows(const SystemTerms& terms,
                                                           const LaplacianSystem& laplacian,
                                                           Kernels& kernels) {
  const std::unique_lock lock(mutex_);
  std::shared_ptr<const BlockRows> rows = held_tangent_rows(terms);
  if (rows != nullptr) return rows;
  rows = lapwing::tangent_rows(topology_, roi_, laplacian, *terms.rest, kernels);
  rows_ = rows;
  rows_terms_ = terms;
  return rows;
}

// Does nothing if the system's memory is already allocated.
void FactorCache::require_memory(std::size_t limit_bytes) {
  if (response_ != nullptr && response_has_memory_) return;
  if (response_ != nullptr) response_bytes_ = response_->memory_bytes();
  limit_bytes = allowed_memory(limit_bytes);
  if (response_bytes_ <= limit_bytes) return;
  response_.reset();
  throw DoesNotFit("the exact system of " + std::to_string(unknowns_.size()) + " vertices needs " +
                   in_megabytes(response_bytes_) + " of memory, more than the limit of " +
                   in_megabytes(limit_bytes));
}

}  // namespace lapwing
