// Based on: M. S. Floater, "Mean value coordinates", Computer Aided Geometric Design 20 (2003).
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/mean_value.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kRowsPerTask = 1024;

// Limit of tan(a / 2), which is infinite at a = 180 degrees, with the vertex on the opposite edge;
// this is 2e-5 short of that. Also limits the ratio of a ring's longest edge to its shortest.
constexpr double kLargestRatio = 1e5;

// Weights below this share of a ring's largest one would be lost to rounding.
constexpr double kSmallestWeightShare = 1e-8;

// tan(30 degrees): next to an edge without length, an angle counts as in an equilateral triangle.
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

// Makes one row: collects both neighbours in each triangle around i, then merges equal neighbours.
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
      // If every angle is 0, all neighbours count the same.
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
    // Around an inner vertex every neighbour is in two triangles.
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

}  // namespace lapwing
