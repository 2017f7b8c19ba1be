#include "lapwing/parameterize/elastic_steps.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/parallel.h"
#include "lapwing/parameterize/planar.h"
#include "lapwing/parameterize/radial_basis_field.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// The share of its area that a triangle keeps in one step. Half gives a flow near enough to the
// continuous one that more steps no longer look smoother, at a third of a step per bump radius.
constexpr double kKeptShare = 0.5;

constexpr std::size_t kPointsPerTask = 512;

// Where every vertex would go if the pulls were followed the whole way.
std::vector<Vector2d> elastic_moves(const WarpedDomain& domain, std::span<const PointPull> pulls,
                                    std::span<const Vector2d> points) {
  std::vector<Vector2d> centres;
  std::vector<Vector2d> displacements;
  for (const PointPull& pull : pulls) {
    centres.push_back(points[pull.vertex]);
    displacements.push_back(pull.target - points[pull.vertex]);
  }
  const RadialBasisField field(domain.chart, centres, displacements);
  std::vector<Vector2d> moves(points.size(), Vector2d::Zero());
  parallel_for(points.size(), kPointsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (domain.is_held[v] == 0) moves[v] = field.at(points[v]);
    }
  });
  // The field is there to rounding; this makes it exact.
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

int step_elastically(const WarpedDomain& domain, std::span<const PointPull> pulls, int most_steps,
                     std::vector<Vector2d>& points) {
  int steps = 0;
  while (steps < most_steps && largest_distance(pulls, points) > 0.0) {
    const std::vector<Vector2d> moves = elastic_moves(domain, pulls, points);
    if (!all_finite(moves)) break;
    const double parts = std::ceil(1.0 / largest_step(domain.triangles, points, moves, kKeptShare));
    if (!(parts <= most_steps)) break;
    std::vector<Vector2d> next = moved(points, moves, 1.0 / parts);
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
