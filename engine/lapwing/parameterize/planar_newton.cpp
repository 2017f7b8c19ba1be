#include "lapwing/parameterize/planar_newton.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/planar.h"
#include "lapwing/solve/ordering.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// Relative shift of the diagonal. Keeps the matrix positive definite if the projection of the twist
// modes leaves eigenvalues of the size of rounding errors.
constexpr double kDiagonalShift = 1e-10;

// Parameters of the line search: the first step as a fraction of the step that flattens a triangle,
// and the required decrease as a fraction of the decrease that the slope predicts.
constexpr double kBarrierShare = 0.9;
constexpr double kSufficientDecrease = 1e-4;
constexpr int kMostHalvings = 30;

// Returns the pattern of the lower triangle, with one block per free vertex.
BlockPattern vertex_pattern(std::span<const Triangle> triangles,
                            std::span<const Index> unknown_of_vertex, std::size_t unknowns) {
  std::vector<std::vector<Index>> below(unknowns);
  for (std::size_t u = 0; u < unknowns; ++u) below[u].push_back(static_cast<Index>(u));
  for (const Triangle& t : triangles) {
    for (const Index v : t) {
      const Index column = unknown_of_vertex[v];
      if (column == kNoIndex) continue;
      for (const Index w : t) {
        const Index row = unknown_of_vertex[w];
        if (row != kNoIndex && row > column) below[column].push_back(row);
      }
    }
  }
  BlockPattern pattern;
  for (std::vector<Index>& rows : below) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern.rows.insert(pattern.rows.end(), rows.begin(), rows.end());
    pattern.starts.push_back(pattern.rows.size());
  }
  return pattern;
}

// Expands a pattern of 2 x 2 blocks to scalars, because the solver does not support blocks of this
// size.
BlockPattern scalar_pattern(const BlockPattern& blocks) {
  BlockPattern scalars;
  for (std::size_t c = 0; c < blocks.size(); ++c) {
    for (const Index second : {0U, 1U}) {
      for (const Index row : blocks.column(c)) {
        if (row != c || second == 0U) scalars.rows.push_back(2 * row);
        scalars.rows.push_back(2 * row + 1);
      }
      scalars.starts.push_back(scalars.rows.size());
    }
  }
  return scalars;
}

}  // namespace

PlanarNewton::PlanarNewton(std::span<const Triangle> triangles, std::span<const Vector2d> rest,
                           std::span<const char> is_held)
    : triangles_(triangles), energy_(triangles, rest), unknown_of_vertex_(rest.size(), kNoIndex) {
  for (std::size_t v = 0; v < rest.size(); ++v) {
    if (is_held[v] == 0) unknown_of_vertex_[v] = static_cast<Index>(unknowns_++);
  }
  make_pattern();
  hessian_ = {&pattern_, 1, Numbers(pattern_.rows.size(), 0.0)};
  gradient_.resize(2 * unknowns_);
  parts_.resize(triangles.size());
}

void PlanarNewton::make_pattern() {
  const BlockPattern blocks = vertex_pattern(triangles_, unknown_of_vertex_, unknowns_);
  pattern_ = scalar_pattern(blocks);
  solver_ = make_solver();
  solver_->analyze(pattern_, 1, scalar_order(fill_reducing_order(blocks), 2));
}

PlanarNewton::BlockPlace PlanarNewton::place(Index row, Index column) const {
  const std::size_t first = pattern_.starts[2 * column];
  const std::size_t second = pattern_.starts[2 * column + 1];
  if (row == column) return {first, second};
  const auto rows = pattern_.column(2 * column);
  const auto at = std::lower_bound(rows.begin(), rows.end(), 2 * row) - rows.begin();
  // The second column does not store the entry above its diagonal.
  return {first + static_cast<std::size_t>(at), second + static_cast<std::size_t>(at) - 1};
}

void PlanarNewton::add_part(const Triangle& triangle, const SymmetricDirichlet::Part& part) {
  for (int a = 0; a < 3; ++a) {
    const Index row = unknown_of_vertex_[triangle[static_cast<std::size_t>(a)]];
    if (row == kNoIndex) continue;
    for (int c = 0; c < 2; ++c)
      gradient_[2 * row + static_cast<Index>(c)] += part.gradient[2 * a + c];
    for (int b = 0; b < 3; ++b) {
      const Index column = unknown_of_vertex_[triangle[static_cast<std::size_t>(b)]];
      if (column == kNoIndex || column > row) continue;
      const auto block = part.hessian.block<2, 2>(2 * a, 2 * b);
      const auto [first, second] = place(row, column);
      hessian_.values[first] += block(0, 0);
      hessian_.values[first + 1] += block(1, 0);
      if (row == column) {
        hessian_.values[second] += block(1, 1);
      } else {
        hessian_.values[second] += block(0, 1);
        hessian_.values[second + 1] += block(1, 1);
      }
    }
  }
}

void PlanarNewton::assemble(std::span<const PointPull> pulls, double stiffness,
                            std::span<const Vector2d> points) {
  constexpr std::size_t kTrianglesPerTask = 256;
  parallel_for(parts_.size(), kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) parts_[t] = energy_.part(t, points);
  });
  std::fill(hessian_.values.begin(), hessian_.values.end(), 0.0);
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  CancelCheck cancel_check;
  for (std::size_t t = 0; t < parts_.size(); ++t) {
    cancel_check();
    add_part(triangles_[t], parts_[t]);
  }
  for (const PointPull& pull : pulls) {
    const Index u = unknown_of_vertex_[pull.vertex];
    for (const Index c : {0U, 1U}) {
      gradient_[2 * u + c] += stiffness * (points[pull.vertex] - pull.target)[c];
      hessian_.values[pattern_.starts[2 * u + c]] += stiffness;
    }
  }
  for (std::size_t c = 0; c < pattern_.size(); ++c) {
    hessian_.values[pattern_.starts[c]] *= 1.0 + kDiagonalShift;
  }
}

double PlanarNewton::objective(std::span<const PointPull> pulls, double stiffness,
                               std::span<const Vector2d> points) const {
  double sum = energy_.energy(points);
  for (const PointPull& pull : pulls) {
    sum += 0.5 * stiffness * (points[pull.vertex] - pull.target).squaredNorm();
  }
  return sum;
}

double PlanarNewton::step(std::span<const PointPull> pulls, double stiffness,
                          std::vector<Vector2d>& points) {
  assemble(pulls, stiffness, points);
  std::vector<double> direction(gradient_.size());
  try {
    solver_->factorize(hessian_);
  } catch (const NotPositiveDefinite&) {
    return 0.0;
  }
  solver_->solve(gradient_, direction, 1);
  std::vector<Vector2d> moves(points.size(), Vector2d::Zero());
  double slope = 0.0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    const Index u = unknown_of_vertex_[v];
    if (u == kNoIndex) continue;
    moves[v] = -Vector2d(direction[2 * u], direction[2 * u + 1]);
    slope += moves[v].dot(Vector2d(gradient_[2 * u], gradient_[2 * u + 1]));
  }
  if (!(slope < 0.0) || !std::isfinite(slope)) return 0.0;

  const double before = objective(pulls, stiffness, points);
  const double barrier = largest_step(triangles_, points, moves, 0.0);
  double length = barrier < 1.0 ? kBarrierShare * barrier : 1.0;
  for (int k = 0; k < kMostHalvings; ++k, length *= 0.5) {
    std::vector<Vector2d> next = moved(points, moves, length);
    const double after = objective(pulls, stiffness, next);
    if (after <= before + kSufficientDecrease * length * slope) {
      points.swap(next);
      return (before - after) / before;
    }
  }
  return 0.0;
}

}  // namespace lapwing
