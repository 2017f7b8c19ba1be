#include "lapwing/deform/region_system.h"

#include <string>
#include <utility>

#include "lapwing/base/limits.h"
#include "lapwing/base/parallel.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {

RegionSystem::RegionSystem(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns)
    : RegionSystem(topology, roi, unknowns,
                   std::make_shared<const SystemPattern>(topology, roi, unknowns)) {}

RegionSystem::RegionSystem(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns,
                           std::shared_ptr<const SystemPattern> pattern)
    : topology_(topology),
      roi_(roi),
      unknowns_(unknowns),
      pattern_(std::move(pattern)),
      laplacian_(topology, roi, unknowns, *pattern_) {}

std::shared_ptr<RegionSystem> RegionSystem::beside() const {
  return std::shared_ptr<RegionSystem>(new RegionSystem(topology_, roi_, unknowns_, pattern_));
}

bool RegionSystem::serves(const VertexSet& roi, const Unknowns& unknowns) const {
  return roi == roi_ && unknowns.vertices == unknowns_.vertices;
}

void RegionSystem::assemble_laplacian(const SystemTerms& terms) {
  if (terms == laplacian_terms_) return;
  const SystemTerms before = std::exchange(laplacian_terms_, {});
  const auto springs = terms.springs ? std::span(*terms.springs) : std::span<const Spring>();
  if (before.rest == terms.rest && before.energy == terms.energy) {
    laplacian_.assemble(laplacian_.shared_weights(), springs);
  } else if (before.rest == terms.rest &&
             before.energy.detail_length == terms.energy.detail_length) {
    laplacian_.assemble(
        std::make_shared<const EnergyWeights>(with_laplacian(
            *laplacian_.shared_weights(), topology_, *terms.rest, roi_, terms.energy.weights)),
        springs);
  } else {
    laplacian_.assemble(*terms.rest, terms.energy, springs);
  }
  laplacian_terms_ = terms;
}

void RegionSystem::analyze_both() {
  const bool is_known = response_ != nullptr || response_bytes_ > 0;
  if (is_known || unknowns_.size() > kMinimumDegreeLimit) return laplacian_.analyze();
  pattern_->thorough_order();  // on all threads
  parallel_invoke([&] { laplacian_.analyze(); }, [&] { analysis_ahead_ = pattern_->analysis(); });
}

void RegionSystem::hold_laplacian(const SystemTerms& terms, std::span<const double> W) {
  assemble_laplacian(terms);
  laplacian_.analyze();
  laplacian_.factor(W);
}

const LaplacianSystem& RegionSystem::laplacian_with_rings() {
  laplacian_.make_rings(*laplacian_terms_.rest);
  return laplacian_;
}

void RegionSystem::hold_response(const SystemTerms& terms, std::span<const double> W,
                                 const DeformOptions& options, Kernels& kernels,
                                 const Progress& progress, StageTimings& timings) {
  if (options.response != response_kind_) {
    response_.reset();
    response_bytes_ = 0;
    response_kind_ = options.response;
  }
  if (response_bytes_ > 0) require_memory(options.memory_limit_bytes);
  if (response_ == nullptr) {
    response_ = std::make_unique<ResponseSystem>(topology_, roi_, unknowns_, *pattern_, laplacian_,
                                                 response_kind_);
    response_terms_ = {};
    response_has_memory_ = false;
  }
  // Elsewhere that goes beside the assembly, which takes little.
  if (unknowns_.size() > kMinimumDegreeLimit) {
    response_->analyze(progress, timings);
    require_memory(options.memory_limit_bytes);
  }
  if (terms != response_terms_) {
    response_terms_ = {};
    assemble_laplacian(terms);
    response_->assemble(*terms.rest, terms.turns_freely, held_tangent_rows(terms), kernels,
                        progress, timings);
    analysis_ahead_.reset();
    response_terms_ = terms;
  }
  require_memory(options.memory_limit_bytes);
  response_has_memory_ = true;
  response_->factor(W, progress, timings);
}

// Null where nobody does. Of what turns freely the response has other rows.
std::shared_ptr<const BlockRows> RegionSystem::held_tangent_rows(const SystemTerms& terms) const {
  const bool response_has = response_ != nullptr && response_kind_ == LinearResponse::tangent &&
                            terms == response_terms_ && !terms.turns_freely;
  if (response_has) return response_->rows();
  return terms == rows_terms_ ? rows_.lock() : nullptr;
}

std::shared_ptr<const BlockRows> RegionSystem::tangent_rows(const SystemTerms& terms,
                                                            Kernels& kernels) {
  std::shared_ptr<const BlockRows> rows = held_tangent_rows(terms);
  if (rows != nullptr) return rows;
  assemble_laplacian(terms);
  rows = lapwing::tangent_rows(topology_, roi_, laplacian_, *terms.rest, kernels);
  rows_ = rows;
  rows_terms_ = terms;
  return rows;
}

// Of a system that has its memory none is required.
void RegionSystem::require_memory(std::size_t limit_bytes) {
  if (response_ != nullptr && response_has_memory_) return;
  if (response_ != nullptr) response_bytes_ = response_->memory_bytes();
  limit_bytes = allowed_memory(limit_bytes);
  if (response_bytes_ <= limit_bytes) return;
  response_.reset();
  throw DoesNotFit("the exact system of " + std::to_string(unknowns_.size()) + " vertices needs " +
                   in_megabytes(response_bytes_) + " of memory, and may take " +
                   in_megabytes(limit_bytes));
}

}  // namespace lapwing
