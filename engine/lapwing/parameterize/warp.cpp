#include "lapwing/parameterize/warp.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "lapwing/parameterize/check_warp.h"
#include "lapwing/parameterize/elastic_steps.h"
#include "lapwing/parameterize/planar.h"
#include "lapwing/parameterize/planar_newton.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// A pull is met if its vertex is this near its target, in extents of the domain.
constexpr double kMet = 1e-6;

// Limits of radial-basis steps: before the constrained parameterization takes over, and after each
// of its iterations, to finish the last part of the way.
constexpr int kMostSteps = 64;
constexpr int kMostLastSteps = 4;

// Springs of the constrained parameterization, in energy per squared extent: first about as stiff
// as the domain, then stiffer if an iteration lowers the objective by less than kSlowDecrease.
constexpr double kFirstStiffness = 10.0;
constexpr double kLastStiffness = 1e9;
constexpr double kStiffer = 4.0;
constexpr double kSlowDecrease = 0.05;

// Retry radial-basis steps once the largest distance is at most this share of that at the last try.
constexpr double kWorthAnotherTry = 0.8;

// Limit for one call, over all attempts.
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

// Iterates until radial-basis steps can finish, or springs of the greatest stiffness do not help.
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

// Tries straight paths, then arcs. If neither arrives, returns the result that comes nearer.
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

// Gives up the pull farthest from its target until the others are met, each pull once at most.
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
