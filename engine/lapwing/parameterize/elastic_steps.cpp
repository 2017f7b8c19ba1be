#include "lapwing/parameterize/elastic_steps.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/planar.h"
#include "lapwing/parameterize/radial_basis_field.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// Fraction of its area that every triangle keeps in one step. A smaller value needs fewer steps,
// but the next step starts from thinner triangles. A larger value hardly reduces the symmetric
// Dirichlet energy of the result.
constexpr double kKeptShare = 0.5;

Vector2d turned(double angle, const Vector2d& p) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

// The remaining paths for time in [0, 1]. The centroid of the pulled vertices moves straight, and
// their offsets from it are interpolated linearly while they rotate.
class RestOfWays {
 public:
  RestOfWays(std::span<const PointPull> pulls, PullWays ways, std::span<const Vector2d> points) {
    for (const PointPull& pull : pulls) {
      from_.push_back(points[pull.vertex]);
      to_.push_back(pull.target);
    }
    if (ways == PullWays::arcs) find_turn();
  }

  const std::vector<Vector2d>& from() const { return from_; }

  std::vector<Vector2d> displacements(double time) const {
    std::vector<Vector2d> result;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      const Vector2d straight = time * (to_[k] - from_[k]);
      if (angle_ == 0.0) {
        result.push_back(straight);
        continue;
      }
      const Vector2d before = from_[k] - middle_from_;
      const Vector2d after = turned(-angle_, to_[k] - middle_to_);
      result.push_back(time * (middle_to_ - middle_from_) +
                       turned(time * angle_, before + time * (after - before)) - before);
    }
    return result;
  }

 private:
  // Computes the least-squares rotation about the centroids.
  void find_turn() {
    const auto count = static_cast<double>(from_.size());
    for (std::size_t k = 0; k < from_.size(); ++k) {
      middle_from_ += from_[k] / count;
      middle_to_ += to_[k] / count;
    }
    Vector2d sum = Vector2d::Zero();
    for (std::size_t k = 0; k < from_.size(); ++k) {
      const Vector2d before = from_[k] - middle_from_;
      const Vector2d after = to_[k] - middle_to_;
      sum += Vector2d(before.dot(after), cross(before, after));
    }
    angle_ = std::atan2(sum.y(), sum.x());
  }

  std::vector<Vector2d> from_;
  std::vector<Vector2d> to_;
  Vector2d middle_from_ = Vector2d::Zero();
  Vector2d middle_to_ = Vector2d::Zero();
  double angle_ = 0.0;
};

// Returns the displacements of all vertices, given those of the pulled vertices.
std::vector<Vector2d> elastic_moves(const WarpedDomain& domain, std::span<const PointPull> pulls,
                                    std::span<const Vector2d> displacements,
                                    std::span<const Vector2d> centres,
                                    std::span<const Vector2d> points) {
  const RadialBasisField field(domain.chart, centres, displacements);
  std::vector<Vector2d> moves(points.size(), Vector2d::Zero());
  constexpr std::size_t kPointsPerTask = 512;
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (domain.is_held[v] == 0) moves[v] = field.at(points[v]);
    }
  });
  // The field interpolates these displacements only up to rounding errors. Make them exact.
  for (std::size_t k = 0; k < pulls.size(); ++k) moves[pulls[k].vertex] = displacements[k];
  return moves;
}

bool all_finite(std::span<const Vector2d> moves) {
  return std::all_of(moves.begin(), moves.end(), [](const Vector2d& m) { return m.allFinite(); });
}

}  // namespace

double largest_distance(std::span<const PointPull> pulls, std::span<const Vector2d> points) {
  double largest = 0.0;
  for (const PointPull& pull : pulls) {
    largest = std::max(largest, (pull.target - points[pull.vertex]).norm());
  }
  return largest;
}

int step_elastically(const WarpedDomain& domain, std::span<const PointPull> pulls, PullWays ways,
                     int most_steps, std::vector<Vector2d>& points) {
  int steps = 0;
  while (steps < most_steps && largest_distance(pulls, points) > 0.0) {
    const RestOfWays rest(pulls, ways, points);
    std::vector<Vector2d> moves;
    // The feasible step of one attempt determines the number of parts for the next. The first part
    // of an arc bends less than the whole arc, so a few attempts suffice.
    double parts = 1.0;
    double step = 0.0;
    while (parts <= most_steps) {
      moves = elastic_moves(domain, pulls, rest.displacements(1.0 / parts), rest.from(), points);
      if (!all_finite(moves)) return steps;
      step = largest_step(domain.triangles, points, moves, kKeptShare);
      if (step >= 1.0) break;
      parts = std::max(parts + 1.0, std::ceil(parts / step));
    }
    if (step < 1.0) break;
    std::vector<Vector2d> next = moved(points, moves, 1.0);
    if (parts == 1.0) {
      for (const PointPull& pull : pulls) next[pull.vertex] = pull.target;
    }
    if (!is_bijective(domain.triangles, next)) break;
    points.swap(next);
    ++steps;
  }
  return steps;
}

}  // namespace lapwing
