#include "lapwing/parameterize/mean_value.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>

#include <Eigen/Geometry>
#include <Eigen/SparseLU>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Limit of the refined points' residual: rounding, with room for rings of many neighbours.
constexpr double kResidualLimit = 1e-12;

// Refinement goes on while it reduces the residual below this share.
constexpr double kLeastGain = 0.5;

// The normal matrix has the square of a ring's size in entries. Beyond this ring size, those of one
// vertex outnumber a whole patch's.
constexpr std::size_t kLargestRingOfNormalEquations = 1000;

// A patch of less area than this share of its extent's square is a line or a point.
constexpr double kSmallestAreaShare = 1e-14;

void require_extent(const Patch& patch, std::span<const Vector3d> positions) {
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!positions[v].allFinite()) {
      throw InputError("vertex " +
                       std::to_string(patch.vertices[std::min(v, patch.vertices.size() - 1)]) +
                       " of the patch has a non-finite position; exclude it, or repair the mesh "
                       "with `lapwing check --fix`");
    }
    box.extend(positions[v]);
  }
  double area = 0.0;
  for (const auto& [a, b, c] : patch.triangles) {
    area += 0.5 * (positions[b] - positions[a]).cross(positions[c] - positions[a]).norm();
  }
  if (area > kSmallestAreaShare * box.diagonal().squaredNorm()) return;
  throw InputError("the patch of " + std::to_string(patch.triangles.size()) +
                   " triangles around vertex " + std::to_string(patch.vertices.front()) +
                   " has zero area, so it cannot be mapped to the plane; choose a region with "
                   "area");
}

// Returns all own vertices that are not on the loop.
std::vector<Index> inner_vertices(const Patch& patch) {
  std::vector<char> on_loop(patch.size(), 0);
  for (const Index v : patch.loop) on_loop[v] = 1;
  std::vector<Index> inner;
  inner.reserve(patch.size() - patch.loop.size());
  CancelCheck cancel_check;
  for (Index v = 0; v < patch.size(); ++v) {
    cancel_check();
    if (on_loop[v] == 0) inner.push_back(v);
  }
  return inner;
}

// Computes the residual of each row: x of all rows, then y. Differences of close points are exact,
// so that rings far smaller than the domain keep all their digits.
void residuals(const BlockRows& A, std::span<const Vector2d> points, std::span<double> r) {
  for (std::size_t row = 0; row < A.size(); ++row) {
    const Vector2d& center = points[A.columns[A.starts[row]]];
    Vector2d sum = Vector2d::Zero();
    for (std::size_t k = A.starts[row] + 1; k < A.starts[row + 1]; ++k) {
      sum -= A.values[k] * (points[A.columns[k]] - center);
    }
    r[row] = sum.x();
    r[A.size() + row] = sum.y();
  }
}

// Solves A dx = r for two columns in place, accurately enough for refinement.
using Correction = std::function<void(std::span<double> columns)>;

Correction normal_equations(const BlockRows& A, const Unknowns& unknowns) {
  struct State {
    State(const BlockRows& A, const Unknowns& unknowns)
        : pattern(A, unknowns), solver(make_solver()) {}
    NormalPattern pattern;
    std::unique_ptr<BlockSolver> solver;
    std::vector<double> transposed;
  };
  const auto state = std::make_shared<State>(A, unknowns);
  const std::vector<double> no_weights(unknowns.size(), 0.0);
  const BlockMatrix N = state->pattern.normal_matrix(A, no_weights);
  state->solver->analyze(state->pattern.blocks(), 1, fill_reducing_order(state->pattern.blocks()));
  state->solver->factorize(N);
  return [state, &A, &unknowns](std::span<double> columns) {
    const std::size_t n = A.size();
    state->transposed.assign(columns.size(), 0.0);
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t k = A.starts[row]; k < A.starts[row + 1]; ++k) {
        const Index unknown = unknowns.of_vertex[A.columns[k]];
        if (unknown == kNoIndex) continue;
        state->transposed[unknown] += A.values[k] * columns[row];
        state->transposed[n + unknown] += A.values[k] * columns[n + row];
      }
    }
    state->solver->solve(state->transposed, columns, 2);
  };
}

Correction sparse_lu(const BlockRows& A, const Unknowns& unknowns) {
  using Matrix = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t row = 0; row < A.size(); ++row) {
    for (std::size_t k = A.starts[row]; k < A.starts[row + 1]; ++k) {
      const Index unknown = unknowns.of_vertex[A.columns[k]];
      if (unknown == kNoIndex) continue;
      entries.emplace_back(static_cast<int>(row), static_cast<int>(unknown), A.values[k]);
    }
  }
  const auto n = static_cast<Eigen::Index>(A.size());
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const auto lu = std::make_shared<Eigen::SparseLU<Matrix>>();
  lu->compute(matrix);
  if (lu->info() != Eigen::Success) {
    throw SolverError("the mean value system cannot be factored: " + lu->lastErrorMessage());
  }
  return [lu, n](std::span<double> columns) {
    Eigen::Map<Eigen::MatrixXd> both(columns.data(), n, 2);
    both = lu->solve(both).eval();
  };
}

// Corrects the inner points until the residual falls no further. Returns the residual.
double refine(const BlockRows& A, std::span<const Index> inner, const Correction& correction,
              std::vector<Vector2d>& points) {
  const std::size_t n = A.size();
  std::vector<double> step(2 * n);
  std::vector<Vector2d> best = points;
  double least = largest_residual(A, points);
  for (;;) {  // ends, since each round but the last halves the residual
    check_cancelled();
    residuals(A, points, step);
    correction(step);
    for (std::size_t k = 0; k < n; ++k) points[inner[k]] += Vector2d(step[k], step[n + k]);
    const double residual = largest_residual(A, points);
    const bool gains = residual < kLeastGain * least;
    if (residual < least) {
      least = residual;
      best = points;
    }
    if (!gains) break;
  }
  points = std::move(best);
  return least;
}

std::size_t largest_ring(const BlockRows& A) {
  std::size_t largest = 0;
  for (std::size_t row = 0; row < A.size(); ++row) {
    largest = std::max(largest, A.starts[row + 1] - A.starts[row]);
  }
  return largest;
}

}  // namespace

double largest_residual(const BlockRows& A, std::span<const Vector2d> points) {
  std::vector<double> r(2 * A.size());
  residuals(A, points, r);
  double largest = 0.0;
  for (const double value : r) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

std::vector<Vector2d> mean_value_points(const Patch& patch, std::span<const Vector3d> own_positions,
                                        std::span<const Vector2d> boundary, MapSolver solver) {
  require_extent(patch, own_positions);
  Vector2d center = Vector2d::Zero();
  for (const Vector2d& p : boundary) center += p / static_cast<double>(boundary.size());
  std::vector<Vector2d> start(patch.size(), center);
  for (std::size_t k = 0; k < patch.loop.size(); ++k) start[patch.loop[k]] = boundary[k];
  const Unknowns unknowns(inner_vertices(patch), patch.size());
  if (unknowns.size() == 0) return start;
  const BlockRows A = mean_value_rows(patch.triangles, own_positions, unknowns.vertices);
  const bool may_square = largest_ring(A) <= kLargestRingOfNormalEquations;
  if (solver == MapSolver::normal_equations || (solver == MapSolver::automatic && may_square)) {
    std::vector<Vector2d> points = start;
    try {
      const double residual = refine(A, unknowns.vertices, normal_equations(A, unknowns), points);
      if (solver == MapSolver::normal_equations) return points;
      if (residual <= kResidualLimit && flipped_triangles(patch.triangles, points).empty()) {
        return points;
      }
    } catch (const NotPositiveDefinite&) {
      // A is regular, but A'A may not be so in double precision.
      if (solver == MapSolver::normal_equations) throw;
    }
  }
  refine(A, unknowns.vertices, sparse_lu(A, unknowns), start);
  return start;
}

}  // namespace lapwing
