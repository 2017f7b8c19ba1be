#include <algorithm>
#include <cmath>
#include <random>

#include "median.h"
#include "solver_rows.h"

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

SolverRow time_solver(const BenchSystem& system, const std::string& name, BlockSolver& solver,
                      Ordering ordering, int repeats) {
  SolverRow row;
  row.name = name;
  std::vector<int> order;
  row.order = median_ms(std::min(repeats, 3),
                        [&] { order = fill_reducing_order(system.pattern, ordering); });
  BlockMatrix matrix = system.coupled;
  row.analyze = median_ms(1, [&] { solver.analyze(system.pattern, 3, order); });
  row.first_factor = median_ms(1, [&] { solver.factor(matrix); });
  row.factor = median_ms(repeats, [&] { solver.factor(matrix); });
  std::mt19937 random(2);
  row.one_diagonal = median_ms(2 * repeats + 1, [&] {
    const auto block = static_cast<Index>(random() % system.pattern.size());
    matrix.values[9 * system.pattern.starts[block]] += 1.0;
    solver.refactor_diagonal(matrix, std::span(&block, 1));
  });
  const std::size_t n = matrix.scalar_size();
  const std::vector<double> b = right_hand_sides(12 * n);
  std::vector<double> x(12 * n);
  row.twelve_columns = median_ms(repeats + 1, [&] { solver.solve(b, x, 12); });
  row.one_column = median_ms(
      2 * repeats + 1, [&] { solver.solve(std::span(b).first(n), std::span(x).first(n), 1); });
  row.error = normwise_backward_error(matrix, std::span(x).first(n), std::span(b).first(n));
  solver.analyze(system.pattern, 1, order);
  solver.factor(system.scalar);
  row.scalar_factor = median_ms(repeats, [&] { solver.factor(system.scalar); });
  return row;
}

}  // namespace lapwing::bench
