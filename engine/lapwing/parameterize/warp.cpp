#include "lapwing/parameterize/warp.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/elastic_steps.h"
#include "lapwing/parameterize/planar.h"
#include "lapwing/parameterize/planar_newton.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

enum class Role : char { unused, inner, boundary, pulled };

[[noreturn]] void refuse(std::size_t pull, Index vertex, const std::string& why) {
  throw InputError(
      "pull " + std::to_string(pull) + " of vertex " + std::to_string(vertex) + ": " + why,
      {vertex});
}

std::string in_words(const Vector2d& p) {
  std::ostringstream text;
  text << "(" << p.x() << ", " << p.y() << ")";
  return text.str();
}

void check_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                  std::span<const Vector2d> points) {
  const auto known = [&](Index v) { return v < points.size(); };
  if (!std::all_of(boundary.begin(), boundary.end(), known)) {
    throw InputError(
        "the boundary of the domain contains a vertex without a point; the domain has " +
        std::to_string(points.size()) + " points");
  }
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const Triangle& corners = triangles[t];
    if (std::all_of(corners.begin(), corners.end(), known) && doubled_area(corners, points) > 0.0) {
      continue;
    }
    throw InputError("triangle " + std::to_string(t) + " (vertices " + std::to_string(corners[0]) +
                     ", " + std::to_string(corners[1]) + ", " + std::to_string(corners[2]) +
                     ") of the domain is flipped or degenerate; a warp requires a bijective map");
  }
}

std::vector<Role> roles(std::span<const Triangle> triangles, std::span<const Index> boundary,
                        std::size_t size) {
  std::vector<Role> role(size, Role::unused);
  for (const Triangle& t : triangles) {
    for (const Index v : t) role[v] = Role::inner;
  }
  for (const Index v : boundary) role[v] = Role::boundary;
  return role;
}

void append_coinciding(std::span<const PointPull> pulls, double tolerance,
                       std::vector<Index>& found) {
  // Sort by x, so that only close targets are compared.
  std::vector<Index> order(pulls.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return pulls[a].target.x() < pulls[b].target.x() ||
           (pulls[a].target.x() == pulls[b].target.x() && a < b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const Vector2d apart = pulls[order[j]].target - pulls[order[i]].target;
      if (apart.x() > tolerance) break;
      if (apart.norm() <= tolerance) found.insert(found.end(), {order[i], order[j]});
    }
  }
}

// Throws InputError, naming the pull and the vertex, if a warp is impossible. No triangle of
// `points` may be inverted or degenerate. Each pulled vertex must be a corner of a triangle, not on
// the boundary, and pulled only once. Its target must be inside the boundary.
void check_warp(std::span<const Triangle> triangles, std::span<const Index> boundary,
                std::span<const Vector2d> points, std::span<const PointPull> pulls) {
  check_domain(triangles, boundary, points);
  std::vector<Role> role = roles(triangles, boundary, points.size());
  for (std::size_t k = 0; k < pulls.size(); ++k) {
    const auto& [vertex, target] = pulls[k];
    if (vertex >= points.size()) {
      refuse(k, vertex,
             "the vertex does not exist; the domain has " + std::to_string(points.size()) +
                 " vertices");
    }
    switch (role[vertex]) {
      case Role::unused:
        refuse(k, vertex, "the vertex belongs to no triangle; pull a vertex of a triangle");
      case Role::boundary:
        refuse(k, vertex,
               "the vertex is on the boundary, which a warp does not move; pull an inner vertex");
      case Role::pulled:
        refuse(k, vertex, "the vertex is already pulled; pull each vertex only once");
      case Role::inner:
        role[vertex] = Role::pulled;
    }
    if (!target.allFinite() || !is_inside(target, boundary, points)) {
      refuse(k, vertex,
             "the target " + in_words(target) +
                 " is not inside the boundary of the domain; choose a target inside it");
    }
  }
}

// Returns, in ascending order, the pulls that contradict each other, so that no bijection satisfies
// all of them. Two pulls contradict each other if their targets are closer than `tolerance`. Pulls
// also contradict each other if they invert or flatten a triangle whose corners are all pulled or
// fixed.
std::vector<Index> contradicting_pulls(std::span<const Triangle> triangles,
                                       std::span<const char> is_held,
                                       std::span<const Vector2d> points,
                                       std::span<const PointPull> pulls, double tolerance) {
  std::vector<Index> found;
  append_coinciding(pulls, tolerance, found);
  std::vector<Index> pull_of_vertex(points.size(), kNoIndex);
  std::vector<Vector2d> ends(points.begin(), points.end());
  for (Index k = 0; k < pulls.size(); ++k) {
    pull_of_vertex[pulls[k].vertex] = k;
    ends[pulls[k].vertex] = pulls[k].target;
  }
  for (const Triangle& t : triangles) {
    const bool is_settled = std::all_of(t.begin(), t.end(), [&](Index v) {
      return is_held[v] != 0 || pull_of_vertex[v] != kNoIndex;
    });
    if (!is_settled || doubled_area(t, ends) > 0.0) continue;
    for (const Index v : t) {
      if (pull_of_vertex[v] != kNoIndex) found.push_back(pull_of_vertex[v]);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// A pull is satisfied if the distance of its vertex from its target is at most this fraction of the
// extent of the domain.
constexpr double kMet = 1e-6;

// Maximum numbers of radial basis steps: before the constrained parameterization starts, and after
// each of its iterations.
constexpr int kMostSteps = 64;
constexpr int kMostLastSteps = 4;

// Spring stiffness of the constrained parameterization, in energy per squared extent. It starts at
// about the stiffness of the domain and increases if an iteration decreases the objective by less
// than kSlowDecrease.
constexpr double kFirstStiffness = 10.0;
constexpr double kLastStiffness = 1e9;
constexpr double kStiffer = 4.0;
constexpr double kSlowDecrease = 0.05;

// Radial basis steps are tried again if the largest distance from a target is at most this fraction
// of the distance at the previous attempt.
constexpr double kWorthAnotherTry = 0.8;

// Maximum number of iterations in one call of `warp_domain`.
constexpr int kMostConstrainedSteps = 150;

WarpedDomain make_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                         std::span<const Vector2d> points) {
  WarpedDomain domain{triangles, DomainChart(boundary, points), {}, extent(triangles, points)};
  domain.is_held.assign(points.size(), 1);
  for (const Triangle& t : triangles) {
    for (const Index v : t) domain.is_held[v] = 0;
  }
  for (const Index v : boundary) domain.is_held[v] = 1;
  return domain;
}

// Iterates until radial basis steps can satisfy all pulls or the stiffness reaches its limit.
void pull_constrained(const WarpedDomain& domain, std::span<const PointPull> pulls,
                      PlanarNewton& newton, std::vector<Vector2d>& points, WarpReport& report) {
  const double unit = 1.0 / (domain.extent * domain.extent);
  double stiffness = kFirstStiffness;
  double tried_at = std::numeric_limits<double>::infinity();
  while (stiffness <= kLastStiffness && report.constrained_steps < kMostConstrainedSteps) {
    const double decrease = newton.step(pulls, stiffness * unit, points);
    ++report.constrained_steps;
    if (decrease < kSlowDecrease) stiffness *= kStiffer;
    const double rest = largest_distance(pulls, points);
    if (rest > kWorthAnotherTry * tried_at) continue;
    tried_at = rest;
    std::vector<Vector2d> finished = points;
    const int steps = step_elastically(domain, pulls, PullWays::straight, kMostLastSteps, finished);
    if (largest_distance(pulls, finished) > 0.0) continue;
    report.steps += steps;
    points.swap(finished);
    return;
  }
}

std::size_t farthest(std::span<const PointPull> pulls, std::span<const Vector2d> points) {
  const auto distance = [&](const PointPull& p) { return (p.target - points[p.vertex]).norm(); };
  return static_cast<std::size_t>(std::max_element(pulls.begin(), pulls.end(),
                                                   [&](const PointPull& a, const PointPull& b) {
                                                     return distance(a) < distance(b);
                                                   }) -
                                  pulls.begin());
}

// Tries straight paths, then arcs. If neither reaches all targets, returns the better result.
std::vector<Vector2d> follow_ways(const WarpedDomain& domain, std::span<const PointPull> pulls,
                                  std::span<const Vector2d> start, WarpReport& report) {
  std::vector<Vector2d> best;
  double least = std::numeric_limits<double>::infinity();
  for (const PullWays ways : {PullWays::straight, PullWays::arcs}) {
    std::vector<Vector2d> points(start.begin(), start.end());
    const int steps = step_elastically(domain, pulls, ways, kMostSteps, points);
    const double rest = largest_distance(pulls, points);
    if (!(rest < least)) continue;
    report.steps = steps;
    least = rest;
    best.swap(points);
    if (least == 0.0) break;
  }
  return best;
}

// Removes the pull that is farthest from its target, until all remaining pulls are satisfied.
std::vector<Vector2d> warp(const WarpedDomain& domain, std::vector<PointPull> pulls,
                           std::span<const Vector2d> start, WarpReport& report) {
  std::unique_ptr<PlanarNewton> newton;
  while (true) {
    std::vector<Vector2d> points = follow_ways(domain, pulls, start, report);
    if (!(largest_distance(pulls, points) > 0.0)) return points;
    if (!newton) newton = std::make_unique<PlanarNewton>(domain.triangles, start, domain.is_held);
    pull_constrained(domain, pulls, *newton, points, report);
    if (largest_distance(pulls, points) <= kMet * domain.extent ||
        report.constrained_steps >= kMostConstrainedSteps) {
      return points;
    }
    pulls.erase(pulls.begin() + static_cast<std::ptrdiff_t>(farthest(pulls, points)));
  }
}

}  // namespace

WarpResult warp_domain(std::span<const Triangle> triangles, std::span<const Index> boundary,
                       std::span<const Vector2d> points, std::span<const PointPull> pulls) {
  check_warp(triangles, boundary, points, pulls);
  const WarpedDomain domain = make_domain(triangles, boundary, points);
  const double tolerance = kMet * domain.extent;
  const std::vector<Index> hopeless =
      contradicting_pulls(triangles, domain.is_held, points, pulls, tolerance);
  std::vector<PointPull> consistent;
  for (Index k = 0; k < pulls.size(); ++k) {
    if (!std::binary_search(hopeless.begin(), hopeless.end(), k)) consistent.push_back(pulls[k]);
  }

  WarpResult result;
  result.points = warp(domain, std::move(consistent), points, result.report);
  for (Index k = 0; k < pulls.size(); ++k) {
    const double distance = (pulls[k].target - result.points[pulls[k].vertex]).norm();
    result.report.distances.push_back(distance);
    if (distance > tolerance) result.report.unmet.push_back(k);
  }
  return result;
}

}  // namespace lapwing
