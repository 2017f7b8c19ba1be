#include <algorithm>
#include <cmath>
#include <random>

#include "run/measure.h"
#include "studies/solver_rows.h"

namespace lapwing::bench {
namespace {

double largest(std::span<const double> v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

std::vector<double> right_hand_sides(std::size_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> b(count);
  for (double& x : b) x = number(random);
  return b;
}

double normwise_backward_error(const BlockMatrix& A, std::span<const double> x,
                               std::span<const double> b) {
  BlockMatrix absolute = A;
  for (double& value : absolute.values) value = std::abs(value);
  std::vector<double> r(b.size());
  multiply(absolute, std::vector<double>(b.size(), 1.0), r, 1);
  const double norm = largest(r);
  multiply(A, x, r, 1);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] -= b[i];
  return largest(r) / (norm * largest(x) + largest(b));
}

SolverRow time_solver(const BenchSystem& system, const std::string& name,
                      const std::function<std::unique_ptr<BlockSolver>()>& make, Ordering ordering,
                      int repeats) {
  SolverRow row;
  row.name = name;
  std::vector<int> order;
  row.order = measure(std::min(repeats, 3), [&] {
                order = fill_reducing_order(system.pattern, ordering);
              }).median();
  BlockMatrix matrix = system.coupled;
  std::unique_ptr<BlockSolver> solver;
  Samples analyze;
  Samples first_factor;
  for (int i = 0; i < repeats; ++i) {
    solver = make();
    Stopwatch watch;
    solver->analyze(system.pattern, 3, order);
    analyze.milliseconds.push_back(watch.elapsed_ms());
    touch_memory(solver->statistics().peak_bytes);
    watch.restart();
    solver->factorize(matrix);
    first_factor.milliseconds.push_back(watch.elapsed_ms());
  }
  row.analyze = analyze.median();
  row.first_factor = first_factor.median();
  row.factor = measure_cold(repeats, [&] { solver->factorize(matrix); }).median();
  std::mt19937 random(2);
  row.one_diagonal = measure(2 * repeats, [&] {
                       const auto block = static_cast<Index>(random() % system.pattern.size());
                       matrix.values[9 * system.pattern.starts[block]] += 1.0;
                       solver->refactorize_diagonal(matrix, std::span(&block, 1));
                     }).median();
  const std::size_t n = matrix.scalar_size();
  const std::vector<double> b = right_hand_sides(12 * n);
  std::vector<double> x(12 * n);
  row.twelve_columns = measure(repeats, [&] { solver->solve(b, x, 12); }).median();
  const auto b1 = std::span(b).first(n);
  const auto x1 = std::span(x).first(n);
  row.one_column = measure(2 * repeats, [&] { solver->solve(b1, x1, 1); }).median();
  row.error = normwise_backward_error(matrix, x1, b1);
  solver->analyze(system.pattern, 1, order);
  row.scalar_factor = measure(repeats, [&] { solver->factorize(system.scalar); }).median();
  return row;
}

}  // namespace lapwing::bench
