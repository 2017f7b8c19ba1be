#include "lapwing/parameterize/domain_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/mean_value.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Returns the name of a pin for messages. A midpoint has no vertex index in the mesh.
std::string name_pin(const Patch& patch, Index pin) {
  if (pin < patch.vertices.size()) return "vertex " + std::to_string(patch.vertices[pin]);
  return "local vertex " + std::to_string(pin) + " of the patch";
}

std::string names(const Patch& patch, const BoundaryPins& pins) {
  std::string text;
  for (const Index pin : pins) text += (text.empty() ? "" : ", ") + name_pin(patch, pin);
  return text;
}

// Returns the number of edges from one position in a loop of n vertices to another; n if both are
// equal.
std::size_t edges_between(std::size_t from, std::size_t to, std::size_t n) {
  return from < to ? to - from : to + n - from;
}

std::vector<std::size_t> pin_places(const Patch& patch, Domain domain, const BoundaryPins& pins) {
  const std::size_t needed = pin_count(domain);
  if (pins.size() != needed) {
    throw InputError(std::string(domain == Domain::disk ? "the disk" : "the square") + " needs " +
                     std::to_string(needed) +
                     (needed == 1 ? " pinned boundary vertex" : " pinned boundary vertices") +
                     ", got " + std::to_string(pins.size()));
  }
  std::vector<std::size_t> places;
  for (const Index pin : pins) {
    const auto at = std::find(patch.loop.begin(), patch.loop.end(), pin);
    if (at == patch.loop.end()) {
      throw InputError(name_pin(patch, pin) +
                       " cannot be pinned: it is not on the boundary of the patch; choose a "
                       "boundary vertex, such as vertex " +
                       std::to_string(patch.vertices[patch.loop.front()]));
    }
    places.push_back(static_cast<std::size_t>(at - patch.loop.begin()));
  }
  std::size_t passed = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    passed += edges_between(places[k], places[(k + 1) % places.size()], patch.loop.size());
  }
  if (passed != patch.loop.size()) {
    throw InputError("the pins " + names(patch, pins) +
                     " are not in order around the boundary; give four different vertices, "
                     "counterclockwise as seen from outside");
  }
  return places;
}

// Returns the lengths of the loop's edges, divided by their mean. Edge k starts at loop vertex k.
std::vector<double> edge_lengths(const Patch& patch, std::span<const Vector3d> own_positions) {
  const std::size_t n = patch.loop.size();
  std::vector<double> lengths(n);
  double sum = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    lengths[k] = (own_positions[patch.loop[(k + 1) % n]] - own_positions[patch.loop[k]]).norm();
    sum += lengths[k];
  }
  const double mean = sum > 0.0 ? sum / static_cast<double>(n) : 1.0;
  for (double& length : lengths) length = std::max(length / mean, kShortestBoundaryEdge);
  return lengths;
}

// Returns the boundary point at the fraction `share` of the side from pin `p` to the next pin.
Vector2d point_at(Domain domain, std::size_t p, double share) {
  if (domain == Domain::disk) {
    const double angle = 2.0 * std::numbers::pi * share;
    return {std::cos(angle), std::sin(angle)};
  }
  constexpr std::array<std::array<double, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const Vector2d from(kCorners[p].data());
  const Vector2d to(kCorners[(p + 1) % 4].data());
  return from + share * (to - from);
}

}  // namespace

std::vector<Vector2d> boundary_points(const Patch& patch, std::span<const Vector3d> own_positions,
                                      Domain domain, const BoundaryPins& pins) {
  const std::vector<std::size_t> places = pin_places(patch, domain, pins);
  const std::vector<double> lengths = edge_lengths(patch, own_positions);
  const std::size_t n = patch.loop.size();
  std::vector<Vector2d> points(n);
  for (std::size_t p = 0; p < places.size(); ++p) {
    const std::size_t edges = edges_between(places[p], places[(p + 1) % places.size()], n);
    double total = 0.0;
    for (std::size_t k = 0; k < edges; ++k) total += lengths[(places[p] + k) % n];
    double passed = 0.0;
    for (std::size_t k = 0; k < edges; ++k) {
      const std::size_t at = (places[p] + k) % n;
      points[at] = point_at(domain, p, passed / total);
      passed += lengths[at];
    }
  }
  return points;
}

DomainMap mean_value_map(const Patch& patch, std::span<const Eigen::Vector3d> own_positions,
                         Domain domain, const BoundaryPins& pins) {
  const std::vector<Vector2d> boundary = boundary_points(patch, own_positions, domain, pins);
  return {domain, mean_value_points(patch, own_positions, boundary)};
}

std::vector<Index> flipped_triangles(std::span<const Triangle> triangles,
                                     std::span<const Vector2d> points) {
  // Relative rounding error of the doubled area.
  constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();
  std::vector<Index> flipped;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vector2d u = points[b] - points[a];
    const Vector2d v = points[c] - points[a];
    const double doubled_area = u.x() * v.y() - u.y() * v.x();
    if (!(doubled_area > kRounding * u.norm() * v.norm())) flipped.push_back(static_cast<Index>(t));
  }
  return flipped;
}

}  // namespace lapwing
