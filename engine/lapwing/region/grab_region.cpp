#include "lapwing/region/grab_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/region/geodesic.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Lengths and distances in this section are in brush radii.
constexpr double kStep = 0.25;     // between the circles that are measured
constexpr double kFirst = 0.5;     // radius of the first circle
constexpr double kLargest = 10.0;  // radius of the last circle
constexpr double kShortestLimb = 2.0;
// Radius of a region that no limb bounds. A limb begins at most this far from the vertex.
constexpr double kWithoutLimb = 3.0;

// On a limb, the lengths of the circles differ from their median by at most this fraction.
constexpr double kVariation = 1.0 / 3.0;

// On a plane or a cone, the length grows in proportion to the radius, so it is not nearly constant
// over a larger ratio of radii. Any ratio above 2 would do; this one also excludes most domes.
constexpr double kFarther = 2.5;

// A part that the disk cuts off moves along if its area is less than this fraction of the rest.
constexpr double kCutOff = 0.5;

double radius_of(std::size_t circle) {
  return kFirst + kStep * static_cast<double>(circle);
}

// Returns the lengths of the circles of radius `radius_of(k) * brush` up to `largest` brush radii.
std::vector<double> circle_lengths(const Topology& topology, std::span<const Vector3d> positions,
                                   std::span<const double> distances, double brush,
                                   double largest) {
  const auto count = static_cast<std::size_t>((largest - kFirst) / kStep) + 1;
  std::vector<double> lengths(count, 0.0);
  for (const Triangle& t : topology.triangles) {
    std::array<std::size_t, 3> corner{0, 1, 2};
    std::ranges::sort(corner, {}, [&](std::size_t k) { return distances[t[k]]; });
    const Index low = t[corner[0]];
    const Index middle = t[corner[1]];
    const Index high = t[corner[2]];
    if (!std::isfinite(distances[high])) continue;
    const auto crossing = [&](Index a, Index b, double radius) -> Vector3d {
      const double way = (radius - distances[a]) / (distances[b] - distances[a]);
      return positions[a] + way * (positions[b] - positions[a]);
    };
    const double first = std::ceil((distances[low] / brush - kFirst) / kStep);
    for (auto k = static_cast<std::size_t>(std::max(first, 0.0)); k < count; ++k) {
      const double radius = radius_of(k) * brush;
      if (radius >= distances[high]) break;
      if (radius < distances[low]) continue;
      const Vector3d from = crossing(low, high, radius);
      const Vector3d to = radius < distances[middle] ? crossing(low, middle, radius)
                                                     : crossing(middle, high, radius);
      lengths[k] += (to - from).norm();
    }
  }
  return lengths;
}

// Calls `visit(first, last, median)` for all intervals of circles that may be a limb: their lengths
// are nearly constant, and they begin near the grabbed vertex.
template <class Visit>
void visit_limbs(std::span<const double> lengths, const Visit& visit) {
  constexpr auto kShortest = static_cast<std::size_t>(kShortestLimb / kStep);
  std::vector<double> sorted;
  for (std::size_t first = 0; first < lengths.size() && radius_of(first) <= kWithoutLimb; ++first) {
    sorted.clear();
    for (std::size_t last = first; last < lengths.size() && lengths[last] > 0.0; ++last) {
      sorted.insert(std::ranges::lower_bound(sorted, lengths[last]), lengths[last]);
      const double median = sorted[sorted.size() / 2];
      const bool is_level = sorted.front() >= (1.0 - kVariation) * median &&
                            sorted.back() <= (1.0 + kVariation) * median;
      const bool is_far = radius_of(last) > kFarther * radius_of(first);
      if (is_level && is_far && last - first >= kShortest) visit(first, last, median);
    }
  }
}

bool may_be_limb(std::span<const double> lengths) {
  bool is_one = false;
  visit_limbs(lengths, [&](auto...) { is_one = true; });
  return is_one;
}

// Returns the circle at which a limb joins the body, or nothing if there is no limb.
std::optional<std::size_t> end_of_limb(std::span<const double> lengths) {
  std::optional<std::size_t> end;
  std::size_t longest = 0;
  visit_limbs(lengths, [&](std::size_t first, std::size_t last, double median) {
    const bool opens = last + 1 < lengths.size() && lengths[last + 1] > (1.0 + kVariation) * median;
    if (!opens || last - first <= longest) return;
    longest = last - first;
    end = last;
  });
  return end;
}

double area_of(const Triangle& t, std::span<const Vector3d> positions) {
  const Vector3d ab = positions[t[1]] - positions[t[0]];
  return 0.5 * ab.cross(positions[t[2]] - positions[t[0]]).norm();
}

// Returns the largest radius at most `radius` whose disk covers at most half of the area of the
// component of `center`. `distances` are complete up to `radius`.
double limited_to_half(double radius, const Topology& topology, std::span<const Vector3d> positions,
                       std::span<const double> distances, Index center) {
  const Components components = connected_components(topology.rings);
  double component_area = 0.0;
  std::vector<std::pair<double, double>> covered;  // largest distance of a corner, area
  double covered_area = 0.0;
  for (const Triangle& t : topology.triangles) {
    if (components.of_vertex[t[0]] != components.of_vertex[center]) continue;
    const double area = area_of(t, positions);
    component_area += area;
    const double farthest = std::max({distances[t[0]], distances[t[1]], distances[t[2]]});
    if (farthest > radius) continue;
    covered_area += area;
    covered.emplace_back(farthest, area);
  }
  if (covered_area <= 0.5 * component_area) return radius;
  std::ranges::sort(covered);
  double area = 0.0;
  for (const auto& [distance, of_triangle] : covered) {
    area += of_triangle;
    if (area > 0.5 * component_area) return distance;
  }
  return radius;
}

// Returns the vertices of the parts into which the disk divides the rest of its component, without
// the largest part and those that are nearly as large.
VertexSet parts_cut_off(const Topology& topology, std::span<const Vector3d> positions,
                        std::span<const double> distances, double radius) {
  constexpr Index kInside = kNoIndex - 1;
  std::vector<Index> part(topology.vertex_count(), kNoIndex);
  for (Index v = 0; v < part.size(); ++v) {
    if (distances[v] <= radius) part[v] = kInside;
  }
  std::vector<double> areas;
  std::vector<Index> open;
  const auto spread = [&](Index to) {
    if (part[to] != kNoIndex) return;
    part[to] = static_cast<Index>(areas.size());
    open.push_back(to);
  };
  for (Index v = 0; v < part.size(); ++v) {
    if (part[v] != kInside) continue;
    for (const Index start : topology.rings[v]) {
      spread(start);
      if (open.empty()) continue;
      while (!open.empty()) {
        const Index at = open.back();
        open.pop_back();
        for (const Index next : topology.rings[at]) spread(next);
      }
      areas.push_back(0.0);
    }
  }
  if (areas.size() < 2) return {};
  for (const Triangle& t : topology.triangles) {
    for (const Index v : t) {
      if (part[v] < kInside) areas[part[v]] += area_of(t, positions) / 3.0;
    }
  }
  const double largest = std::ranges::max(areas);
  VertexSet cut_off;
  for (Index v = 0; v < part.size(); ++v) {
    if (part[v] < kInside && areas[part[v]] < kCutOff * largest) cut_off.push_back(v);
  }
  return cut_off;
}

}  // namespace

GrabRegion grab_region(const Topology& topology, std::span<const Vector3d> positions, Index center,
                       double brush, double factor) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  if (!is_positive(brush) || !is_positive(factor)) {
    throw InputError("A grab needs a brush radius and a factor that are finite and positive.");
  }
  if (center >= topology.vertex_count() || topology.rings[center].empty()) {
    throw InputError("Vertex " + std::to_string(center) +
                     " belongs to no triangle, so it cannot be grabbed.");
  }
  std::vector<double> distances;
  const auto measure_to = [&](double largest) {
    const double reach = brush * largest * std::max(1.0, factor);
    distances = geodesic_distances(topology, positions, {&center, 1}, reach);
    return circle_lengths(topology, positions, distances, brush, largest);
  };
  // Most of a large mesh is never visited if no limb begins near the vertex.
  std::optional<std::size_t> limb;
  if (may_be_limb(measure_to(kWithoutLimb + kShortestLimb))) {
    limb = end_of_limb(measure_to(kLargest));
  }
  GrabRegion region;
  region.is_limb = limb.has_value();
  region.radius = limited_to_half(factor * brush * (limb ? radius_of(*limb) : kWithoutLimb),
                                  topology, positions, distances, center);
  region.cut_off = parts_cut_off(topology, positions, distances, region.radius);
  return region;
}

}  // namespace lapwing
