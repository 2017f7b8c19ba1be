#include "lapwing/deform/region_system.h"

#include <string>

#include "lapwing/base/memory_use.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {

RegionSystem::RegionSystem(const Topology& topology, const VertexSet& roi, const Unknowns& unknowns)
    : topology_(topology),
      roi_(roi),
      unknowns_(unknowns),
      pattern_(topology, roi, unknowns),
      laplacian_(topology, roi, unknowns, pattern_) {}

bool RegionSystem::serves(const VertexSet& roi, const Unknowns& unknowns) const {
  return roi == roi_ && unknowns.vertices == unknowns_.vertices;
}

void RegionSystem::assemble_laplacian(const SystemTerms& terms) {
  if (terms == laplacian_terms_) return;
  laplacian_terms_ = {};
  laplacian_.assemble(*terms.rest, terms.weights, terms.stretch_resistance);
  laplacian_terms_ = terms;
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

void RegionSystem::hold_rsi(const SystemTerms& terms, std::span<const double> weights,
                            std::span<const double> W, const DeformOptions& options,
                            Kernels& kernels, const Progress& progress, StageTimings& timings) {
  if (options.solver != rsi_solver_) {
    rsi_.reset();
    rsi_bytes_ = 0;
    rsi_solver_ = options.solver;
  }
  if (rsi_bytes_ > 0) require_memory(options.memory_limit_bytes);
  if (rsi_ == nullptr) {
    rsi_ = std::make_unique<RsiSolution>(topology_, roi_, unknowns_, pattern_, rsi_solver_);
    rsi_terms_ = {};
    rsi_has_memory_ = false;
  }
  // Elsewhere that goes beside the assembly, which takes little.
  if (unknowns_.size() > kMinimumDegreeLimit) {
    rsi_->analyze(progress, timings);
    require_memory(options.memory_limit_bytes);
  }
  if (terms != rsi_terms_) {
    rsi_terms_ = {};
    rsi_->assemble(*terms.rest, weights, kernels, progress, timings);
    rsi_terms_ = terms;
  }
  require_memory(options.memory_limit_bytes);
  rsi_has_memory_ = true;
  rsi_->factor(W, progress, timings);
}

// Of a system that has its memory none is required.
void RegionSystem::require_memory(std::size_t limit_bytes) {
  if (rsi_ != nullptr && rsi_has_memory_) return;
  if (rsi_ != nullptr) rsi_bytes_ = rsi_->memory_bytes();
  if (limit_bytes == 0) {
    const auto available = static_cast<double>(available_memory_bytes());
    if (available == 0.0) return;
    limit_bytes = static_cast<std::size_t>(kMemoryShare * available);
  }
  if (rsi_bytes_ <= limit_bytes) return;
  rsi_.reset();
  const auto megabytes = [](std::size_t bytes) {
    return std::to_string(bytes / 1'000'000 + 1) + " MB";
  };
  throw DoesNotFit("the exact system of " + std::to_string(unknowns_.size()) + " vertices needs " +
                   megabytes(rsi_bytes_) + " of memory, and may take " + megabytes(limit_bytes));
}

}  // namespace lapwing
