// Based on: M. S. Floater, "Mean value coordinates", Computer Aided Geometric Design 20 (2003).
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
#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/solve/block_solver.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Solves A dx = r in place for two columns, accurately enough for refinement.
using Correction = std::function<void(std::span<double> columns)>;

constexpr std::size_t kRowsPerTask = 1024;

// Upper bound of tan(a / 2), which is infinite for a = 180 degrees, if the vertex is on the
// opposite edge. The bound is reached 2e-5 radians before. It also limits the ratio of the longest
// to the shortest edge of a ring.
constexpr double kLargestRatio = 1e5;

// Weights are at least this fraction of the largest weight of the ring; smaller ones would vanish
// by rounding.
constexpr double kSmallestWeightShare = 1e-8;

// tan(30 degrees): an angle next to a zero-length edge is treated as an angle of an equilateral
// triangle.
constexpr double kHalfTangentOfNoAngle = 0.57735026918962576;

double half_tangent(const Vector3d& u, const Vector3d& v) {
  const double lengths = u.norm() * v.norm();
  if (!(lengths > 0.0)) return kHalfTangentOfNoAngle;
  const double sine = u.cross(v).norm();
  // Of the two forms of tan(a / 2), use the one without cancellation.
  const double cosine = u.dot(v);
  if (cosine >= 0.0) return sine / (lengths + cosine);
  return std::min((lengths - cosine) / sine, kLargestRatio);
}

struct Term {
  Index column;
  double half_tangents;
};

// Computes one row: collects both neighbours in each triangle around i, then merges equal
// neighbours.
class RowMaker {
 public:
  RowMaker(std::span<const Triangle> triangles, std::span<const Vector3d> positions)
      : triangles_(triangles), positions_(positions) {}

  void make(Index i, std::span<const Index> around, std::span<Index> columns,
            std::span<double> values) {
    collect(i, around);
    double longest = 0.0;
    for (const Term& term : terms_) longest = std::max(longest, length(i, term.column));
    const double shortest = longest > 0.0 ? longest / kLargestRatio : 1.0;
    double largest = 0.0;
    columns[0] = i;
    values[0] = 1.0;
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      columns[k + 1] = terms_[k].column;
      values[k + 1] = terms_[k].half_tangents / std::max(length(i, terms_[k].column), shortest);
      largest = std::max(largest, values[k + 1]);
    }
    const std::span weights = values.subspan(1);
    double sum = 0.0;
    for (double& w : weights) {
      // If all angles are 0, all neighbours have the same weight.
      w = largest > 0.0 ? std::max(w, kSmallestWeightShare * largest) : 1.0;
      sum += w;
    }
    for (double& w : weights) w /= -sum;
  }

 private:
  double length(Index i, Index j) const { return (positions_[j] - positions_[i]).norm(); }

  void collect(Index i, std::span<const Index> around) {
    terms_.clear();
    for (const Index t : around) {
      const Triangle& triangle = triangles_[t];
      const std::size_t at = triangle[0] == i ? 0 : triangle[1] == i ? 1 : 2;
      const Index j = triangle[(at + 1) % 3];
      const Index k = triangle[(at + 2) % 3];
      const double tangent =
          half_tangent(positions_[j] - positions_[i], positions_[k] - positions_[i]);
      terms_.push_back({j, tangent});
      terms_.push_back({k, tangent});
    }
    std::sort(terms_.begin(), terms_.end(),
              [](const Term& a, const Term& b) { return a.column < b.column; });
    // Each neighbour of an inner vertex is in two triangles.
    for (std::size_t k = 0; 2 * k < terms_.size(); ++k) {
      terms_[k] = {terms_[2 * k].column,
                   terms_[2 * k].half_tangents + terms_[2 * k + 1].half_tangents};
    }
    terms_.resize(terms_.size() / 2);
  }

  std::span<const Triangle> triangles_;
  std::span<const Vector3d> positions_;
  std::vector<Term> terms_;
};

// Largest accepted residual after refinement: the rounding error of rings with many neighbours.
constexpr double kResidualLimit = 1e-12;

// Refinement continues while an iteration reduces the residual at least by this factor.
constexpr double kLeastGain = 0.5;

// A ring of k vertices contributes about k^2 entries to the normal matrix. Beyond this size, one
// ring has more entries than all other rings of a typical patch.
constexpr std::size_t kLargestRingOfNormalEquations = 1000;

// A patch whose area is below this fraction of its squared bounding box diagonal is degenerate.
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

// Computes the residuals of all rows, x before y. Differences of close points are exact, so even
// residuals of very small rings are accurate.
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

// Refines the inner points iteratively until the residual no longer decreases. Returns the
// residual.
double refine(const BlockRows& A, std::span<const Index> inner, const Correction& correction,
              std::vector<Vector2d>& points) {
  const std::size_t n = A.size();
  std::vector<double> step(2 * n);
  std::vector<Vector2d> best = points;
  double least = largest_residual(A, points);
  for (;;) {  // terminates, because every iteration but the last halves the residual
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

BlockRows mean_value_rows(std::span<const Triangle> triangles, std::span<const Vector3d> positions,
                          std::span<const Index> inner) {
  const Adjacency around = triangles_around_vertices(positions.size(), triangles);
  BlockRows A;
  A.block_size = 1;
  A.starts.reserve(inner.size() + 1);
  for (const Index i : inner) A.starts.push_back(A.starts.back() + around.size(i) + 1);
  A.columns.resize(A.starts.back());
  A.values.resize(A.starts.back());
  parallel_for(inner.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    RowMaker maker(triangles, positions);
    for (std::size_t row = begin; row < end; ++row) {
      const std::size_t size = A.starts[row + 1] - A.starts[row];
      maker.make(inner[row], around[inner[row]], std::span(A.columns).subspan(A.starts[row], size),
                 std::span(A.values).subspan(A.starts[row], size));
    }
  });
  return A;
}

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
                                        std::span<const Vector2d> boundary) {
  require_extent(patch, own_positions);
  Vector2d center = Vector2d::Zero();
  for (const Vector2d& p : boundary) center += p / static_cast<double>(boundary.size());
  std::vector<Vector2d> start(patch.size(), center);
  for (std::size_t k = 0; k < patch.loop.size(); ++k) start[patch.loop[k]] = boundary[k];
  const Unknowns unknowns(inner_vertices(patch), patch.size());
  if (unknowns.size() == 0) return start;
  const BlockRows A = mean_value_rows(patch.triangles, own_positions, unknowns.vertices);
  if (largest_ring(A) <= kLargestRingOfNormalEquations) {
    std::vector<Vector2d> points = start;
    try {
      const double residual = refine(A, unknowns.vertices, normal_equations(A, unknowns), points);
      if (residual <= kResidualLimit && flipped_triangles(patch.triangles, points).empty()) {
        return points;
      }
    } catch (const NotPositiveDefinite&) {
      // A is regular, but A'A may be singular in double precision.
    }
  }
  refine(A, unknowns.vertices, sparse_lu(A, unknowns), start);
  return start;
}

}  // namespace lapwing
