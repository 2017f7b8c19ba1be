#include "lapwing/deform/region_system.h"

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
                            std::span<const double> W, SolverKind solver, Kernels& kernels,
                            const Progress& progress, StageTimings& timings) {
  if (rsi_ == nullptr || solver != rsi_solver_) {
    rsi_.reset();
    rsi_terms_ = {};
    rsi_ = std::make_unique<RsiSolution>(topology_, roi_, unknowns_, pattern_, solver);
    rsi_solver_ = solver;
  }
  if (terms != rsi_terms_) {
    rsi_terms_ = {};
    rsi_->assemble(*terms.rest, weights, kernels, progress, timings);
    rsi_terms_ = terms;
  }
  rsi_->factor(W, progress, timings);
}

}  // namespace lapwing
