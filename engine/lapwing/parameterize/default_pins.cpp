#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <Eigen/Geometry>

#include "lapwing/base/errors.h"
#include "lapwing/parameterize/domain_map.h"
#include "lapwing/parameterize/principal_view.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Returns four vertices of the loop a quarter of its length apart, from place `first` on.
BoundaryPins quarters(const Patch& patch, std::span<const Vector3d> positions, std::size_t first) {
  const std::size_t n = patch.loop.size();
  const auto at = [&](std::size_t k) { return patch.loop[(first + k) % n]; };
  std::vector<double> passed(n + 1, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    passed[k + 1] = passed[k] + (positions[at(k + 1)] - positions[at(k)]).norm();
  }
  BoundaryPins pins{at(0)};
  std::size_t k = 0;
  for (std::size_t pin = 1; pin < 4; ++pin) {
    // Each later pin needs a vertex, too.
    const double wanted = 0.25 * static_cast<double>(pin) * passed[n];
    do ++k;
    while (passed[k] < wanted && k + 4 < n + pin);
    pins.push_back(at(k));
  }
  return pins;
}

// Returns the vertices of the loop nearest to the corners of its bounding rectangle.
BoundaryPins corner_pins(const Patch& patch, const PrincipalView& view) {
  Eigen::AlignedBox2d box;
  for (const Index v : patch.loop) box.extend(view(v));
  using Box = Eigen::AlignedBox2d;
  BoundaryPins pins;
  for (const auto corner : {Box::BottomLeft, Box::BottomRight, Box::TopRight, Box::TopLeft}) {
    const Vector2d p = box.corner(corner);
    pins.push_back(
        best_of(patch.loop, view.radius(), [&](Index v) { return -(view(v) - p).norm(); }));
  }
  return pins;
}

std::size_t place_of(const Patch& patch, Index pin) {
  return static_cast<std::size_t>(std::find(patch.loop.begin(), patch.loop.end(), pin) -
                                  patch.loop.begin());
}

// Returns whether the pins are distinct and in order within one round.
bool are_in_order(const Patch& patch, const BoundaryPins& pins) {
  const std::size_t n = patch.loop.size();
  const std::size_t first = place_of(patch, pins[0]);
  std::size_t last = 0;
  for (std::size_t k = 1; k < pins.size(); ++k) {
    const std::size_t step = (place_of(patch, pins[k]) + n - first) % n;
    if (step <= last) return false;
    last = step;
  }
  return true;
}

}  // namespace

BoundaryPins default_pins(const Patch& patch, std::span<const Vector3d> own_positions,
                          Domain domain) {
  if (domain == Domain::square && patch.loop.size() < 4) {
    throw InputError("the square needs 4 boundary vertices, but the patch around vertex " +
                     std::to_string(patch.vertices.front()) + " has " +
                     std::to_string(patch.loop.size()) + "; use the disk, or a larger region");
  }
  double area = 0.0;
  for (const auto& [a, b, c] : patch.triangles) {
    area += 0.5 *
            (own_positions[b] - own_positions[a]).cross(own_positions[c] - own_positions[a]).norm();
  }
  // `mean_value_map` rejects a patch without area, or one that is not finite.
  if (!(area > 0.0) || !std::isfinite(area)) {
    if (domain == Domain::disk) return {patch.loop.front()};
    return quarters(patch, own_positions, 0);
  }
  const PrincipalView view(patch, own_positions);
  if (domain == Domain::disk) {
    return {best_of(patch.loop, view.radius(), [&](Index v) { return view(v).x(); })};
  }
  BoundaryPins pins = corner_pins(patch, view);
  if (are_in_order(patch, pins)) return pins;
  return quarters(patch, own_positions, place_of(patch, pins[0]));
}

}  // namespace lapwing
