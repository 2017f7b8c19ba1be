#include <memory>
#include <optional>
#include <vector>

#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/laplacian/system_pattern.h"
#include "lapwing/solve/block_solver.h"
#include "run/bench_run.h"
#include "run/edit_parts.h"

namespace lapwing::bench {
namespace {

void count_factor(Measurement* row, const SolverStatistics& statistics) {
  if (row == nullptr) return;
  row->counts["flops"] = static_cast<std::uint64_t>(statistics.flops);
  row->counts["nonzeros"] = statistics.factor_bytes / sizeof(double);
}

// Both triangular solves read the whole factor, and use each of its numbers in one multiplication
// and one addition per column.
void count_solve(Measurement* row, const SolverStatistics& statistics, std::size_t size,
                 std::size_t columns) {
  if (row == nullptr) return;
  row->counts["bytes"] = 2 * statistics.factor_bytes + 2 * size * columns * sizeof(double);
  row->counts["flops"] = 4 * statistics.factor_bytes / sizeof(double) * columns;
}

void measure_assembly(BenchRun& run, const EditParts& parts) {
  const Subject& subject = run.subject();
  for (const BenchDevice& device : run.devices()) {
    const bool float64 = device.kernels->device().float64;
    const std::size_t real = float64 ? sizeof(double) : sizeof(float);
    const std::size_t entries = subject.mesh.topology().rings.values.size();
    const std::size_t n = subject.vertices();
    // Reads positions, rings and weights once; writes nine numbers per block.
    const std::uint64_t bytes =
        real * (3 * n + entries + 9 * (n + entries)) + sizeof(Index) * (2 * n + entries);
    BlockRows M;
    Measurement* const row = run.measure("assemble", device, [&] {
      M = assemble_rsi_rows(*device.kernels, parts.ring_problem(subject));
    });
    if (row != nullptr) row->counts["bytes"] = bytes;
    run.add_kernel("assemble_rsi", bytes);
  }
}

void measure_coupled(BenchRun& run, const EditParts& parts) {
  const Subject& subject = run.subject();
  const auto wants = [&](const char* stage) { return run.wants(stage, run.processor()); };
  const bool solves = wants("response") || wants("back-substitution");
  const bool factors = solves || wants("factor");
  if (!factors && !wants("normal matrix") && !wants("analyze")) return;
  const SystemPattern& pattern = *parts.pattern;
  std::unique_ptr<BlockSolver> solver;
  Measurement* row = run.measure(
      "analyze", [&] { solver->analyze(pattern.blocks(), 3, pattern.factorization_order()); },
      [&] { solver = make_solver(); });
  if (solver == nullptr) {
    solver = make_solver();
    solver->analyze(pattern.blocks(), 3, pattern.factorization_order());
  }
  const SolverStatistics statistics = solver->statistics();
  if (row != nullptr) row->counts["nonzeros"] = statistics.factor_bytes / sizeof(double);
  const BlockRows M = assemble_rsi_rows(*run.processor().kernels, parts.ring_problem(subject));
  BlockMatrix N = pattern.normal().normal_matrix(M, parts.constraints.W);
  row = run.measure("normal matrix",
                    [&] { N = pattern.normal().normal_matrix(M, parts.constraints.W); });
  if (row != nullptr) row->counts["bytes"] = sizeof(double) * (M.values.size() + N.values.size());
  if (!factors) return;
  if (statistics.peak_bytes > run.settings().memory_bytes) {
    run.leave_out("the 3n x 3n factor",
                  "it needs " + std::to_string(statistics.peak_bytes / 1'000'000) + " MB");
    return;
  }
  row = run.measure("factor", [&] { solver->factorize(N); });
  count_factor(row, statistics);
  if (!solves) return;
  solver->factorize(N);
  const std::size_t size = N.scalar_size();
  std::vector<double> x(kResponseColumns * size, 1.0);
  row = run.measure(
      "response", [&] { solver->solve(x, x, kResponseColumns); },
      [&] { std::fill(x.begin(), x.end(), 1.0); });
  count_solve(row, statistics, size, kResponseColumns);
  row = run.measure(
      "back-substitution",
      [&] { solver->solve(std::span(x).first(size), std::span(x).first(size), 1); },
      [&] { std::fill(x.begin(), x.end(), 1.0); });
  count_solve(row, statistics, size, 1);
}

}  // namespace

void measure_solver_stages(BenchRun& run) {
  const Subject& subject = run.subject();
  EditParts parts(subject);
  run.measure("pattern", [&] {
    SystemPattern(subject.mesh.topology(), subject.region.roi, parts.constraints.unknowns);
  });
  std::unique_ptr<SystemPattern> unordered;
  run.measure(
      "order", [&] { unordered->factorization_order(); },
      [&] {
        unordered = std::make_unique<SystemPattern>(subject.mesh.topology(), subject.region.roi,
                                                    parts.constraints.unknowns);
      });
  unordered.reset();
  run.measure("laplacian weights", [&] {
    laplacian_weights(subject.mesh.topology(), subject.mesh.positions, LaplacianWeights::uniform);
  });
  parts.pattern->factorization_order();
  run.measure("laplacian", [&] { parts.laplacian_system(subject); });
  measure_assembly(run, parts);
  measure_coupled(run, parts);
}

}  // namespace lapwing::bench
