#include <dlfcn.h>
#include <optional>

#include "run/measure.h"
#include "solvers/cholmod_solver.h"
#include "studies/solver_rows.h"

namespace lapwing::bench {
namespace {

// Does nothing if the BLAS is not OpenBLAS.
void set_blas_threads(int threads) {
  using Setter = void (*)(int);
  static const auto set = reinterpret_cast<Setter>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  if (set != nullptr) set(threads);
}

void set(CholmodSolver& solver, const BlockMatrix& A, std::span<const int> order) {
  solver.set_pattern(*A.pattern, A.block_size, order);
  solver.set_values(A);
}

const char* name_of(CholmodOrdering ordering) {
  switch (ordering) {
    case CholmodOrdering::amd:
      return "CHOLMOD AMD";
    case CholmodOrdering::metis:
      return "CHOLMOD METIS";
    case CholmodOrdering::blocks:
      break;
  }
  return "CHOLMOD METIS on blocks";
}

}  // namespace

SolverRow time_cholmod(const BenchSystem& system, CholmodOrdering ordering, int repeats) {
  SolverRow row;
  row.name = name_of(ordering);
  std::vector<int> order;
  if (ordering == CholmodOrdering::blocks) {
    row.order = measure(std::min(repeats, 3), [&] {
                  order = fill_reducing_order(system.pattern, Ordering::nested_dissection);
                }).median();
  }
  std::optional<CholmodSolver> coupled;
  Samples analyze;
  std::array<Samples, 2> first_factor;
  for (int i = 0; i < repeats; ++i) {
    for (const int threads : {1, 2}) {
      set_blas_threads(threads);
      coupled.emplace(ordering);
      set(*coupled, system.coupled, order);
      Stopwatch watch;
      coupled->analyze();
      analyze.milliseconds.push_back(watch.elapsed_ms());
      touch_memory(coupled->factor_bytes());
      watch.restart();
      coupled->factorize();
      first_factor[static_cast<std::size_t>(threads - 1)].milliseconds.push_back(
          watch.elapsed_ms());
    }
  }
  row.analyze = analyze.median();
  row.first_factor = std::min(first_factor[0].median(), first_factor[1].median());
  const std::size_t n = system.coupled.scalar_size();
  const std::vector<double> b = right_hand_sides(12 * n);
  const auto b1 = std::span(b).first(n);
  CholmodSolver scalar(ordering);
  set(scalar, system.scalar, order);
  scalar.analyze();
  const auto best = [](double& best_so_far, const Samples& samples) {
    const double time = samples.median();
    best_so_far = best_so_far == 0 ? time : std::min(best_so_far, time);
  };
  for (const int threads : {1, 2}) {
    set_blas_threads(threads);
    best(row.factor, measure_cold(repeats, [&] { coupled->factorize(); }));
    best(row.scalar_factor, measure(repeats, [&] { scalar.factorize(); }));
    best(row.twelve_columns, measure(repeats, [&] { coupled->solve(b); }));
    best(row.one_column, measure(2 * repeats, [&] { coupled->solve(b1); }));
  }
  row.error = normwise_backward_error(system.coupled, coupled->solve(b1), b1);
  return row;
}

}  // namespace lapwing::bench
