#include "lapwing/region/grab_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

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
// Radius of a region that is not bounded by a limb. A limb begins at most this far from the vertex.
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

std::size_t circle_count(double largest) {
  return static_cast<std::size_t>((largest - kFirst) / kStep) + 1;
}

// Appends the lengths of the circles of radius `radius_of(k) * brush` for the next k, up to
// `largest` brush radii. `front` must have reached this distance.
void measure_circles(std::vector<double>& lengths, const GeodesicFront& front,
                     const Topology& topology, std::span<const Vector3d> positions, double brush,
                     double largest) {
  const std::span<const double> distances = front.distances();
  const std::size_t begin = lengths.size();
  const double smallest = radius_of(begin) * brush;
  lengths.resize(circle_count(largest), 0.0);
  const auto measure = [&](const Triangle& t, Index highest) {
    std::array<std::pair<double, Index>, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = {distances[t[k]], t[k]};
    std::ranges::sort(corners);
    const auto [low, middle, high] =
        std::array{corners[0].second, corners[1].second, corners[2].second};
    // Each triangle is measured only once, from its farthest corner.
    if (high != highest || !std::isfinite(distances[high])) return;
    const auto crossing = [&](Index a, Index b, double radius) -> Vector3d {
      const double way = (radius - distances[a]) / (distances[b] - distances[a]);
      return positions[a] + way * (positions[b] - positions[a]);
    };
    const double first = std::ceil((distances[low] / brush - kFirst) / kStep);
    const std::size_t from = std::max(begin, static_cast<std::size_t>(std::max(first, 0.0)));
    for (std::size_t k = from; k < lengths.size(); ++k) {
      const double radius = radius_of(k) * brush;
      if (radius >= distances[high]) break;
      if (radius < distances[low]) continue;
      const Vector3d start = crossing(low, high, radius);
      const Vector3d end = radius < distances[middle] ? crossing(low, middle, radius)
                                                      : crossing(middle, high, radius);
      lengths[k] += (end - start).norm();
    }
  };
  for (const Index v : front.reached()) {
    if (distances[v] <= smallest) continue;
    for (const Index t : topology.vertex_triangles[v]) measure(topology.triangles[t], v);
  }
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

// Returns true if more circles must be measured to find the end of a limb: a possible limb ends
// within one brush radius of the last circle.
bool may_go_on(std::span<const double> lengths) {
  constexpr auto kRadius = static_cast<std::size_t>(1.0 / kStep);
  bool goes_on = false;
  visit_limbs(lengths, [&](std::size_t, std::size_t last, double) {
    goes_on = goes_on || last + kRadius >= lengths.size();
  });
  return goes_on;
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

// Returns a third of the area of the triangles around the vertex.
double area_of(Index v, const Topology& topology, std::span<const Vector3d> positions) {
  double area = 0.0;
  for (const Index k : topology.vertex_triangles[v]) {
    const Triangle& t = topology.triangles[k];
    const Vector3d ab = positions[t[1]] - positions[t[0]];
    area += ab.cross(positions[t[2]] - positions[t[0]]).norm() / 6.0;
  }
  return area;
}

// Searches the vertices of the component that are outside the disk.
class Outside {
 public:
  Outside(const GeodesicFront& front, const Topology& topology, double radius)
      : topology_(topology), is_visited_(topology.vertex_count(), 0) {
    for (const Index v : front.reached()) {
      if (front.distances()[v] <= radius) inside_.push_back(v);
    }
    for (const Index v : inside_) is_visited_[v] = 1;
  }

  const std::vector<Index>& inside() const { return inside_; }

  // Returns the vertices outside that have a neighbour inside.
  std::vector<Index> rim() const {
    std::vector<Index> rim;
    for (const Index v : inside_) {
      for (const Index w : topology_.rings[v]) {
        if (is_visited_[w] == 0) rim.push_back(w);
      }
    }
    return make_vertex_set(std::move(rim));
  }

  // Visits all vertices that are connected to `starts` through vertices of `among` and were not
  // visited before. If `among` is empty, all vertices are allowed. Stops if `visit(v)` returns
  // false.
  template <class Visit>
  void spread(std::span<const Index> starts, const Visit& visit,
              std::span<const Index> among = {}) {
    std::vector<Index> open;
    const auto reach = [&](Index v) {
      if (is_visited_[v] != 0) return;
      if (!among.empty() && !std::ranges::binary_search(among, v)) return;
      is_visited_[v] = 1;
      open.push_back(v);
    };
    for (const Index v : starts) reach(v);
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      if (!visit(v)) return;
      for (const Index w : topology_.rings[v]) reach(w);
    }
  }

 private:
  const Topology& topology_;
  std::vector<char> is_visited_;
  std::vector<Index> inside_;
};

// Returns the largest radius up to `radius` whose disk covers at most half of the area of the
// component that contains its centre. `front` must have reached `radius`. Outside the disk, visits
// vertices only up to an area equal to that of the disk.
double limited_to_half(double radius, const GeodesicFront& front, const Topology& topology,
                       std::span<const Vector3d> positions) {
  Outside outside(front, topology, radius);
  std::vector<std::pair<double, double>> covered;  // distance and area of each vertex
  double covered_area = 0.0;
  for (const Index v : outside.inside()) {
    covered.emplace_back(front.distances()[v], area_of(v, topology, positions));
    covered_area += covered.back().second;
  }
  double area_outside = 0.0;
  outside.spread(outside.rim(), [&](Index v) {
    area_outside += area_of(v, topology, positions);
    return area_outside < covered_area;
  });
  if (area_outside >= covered_area) return radius;
  std::ranges::sort(covered);
  double area = 0.0;
  double last = 0.0;
  for (const auto& [distance, of_vertex] : covered) {
    area += of_vertex;
    // A radius halfway between the distances of two vertices makes the disk independent of rounding
    // errors.
    if (area > 0.5 * (covered_area + area_outside)) return 0.5 * (last + distance);
    last = distance;
  }
  return radius;
}

// The parts outside a disk whose area is at most a limit.
struct PartsOutside {
  std::vector<std::pair<double, std::vector<Index>>> whole;  // area and vertices
  double largest = 0.0;                                      // area of the largest of them
  std::size_t larger = 0;  // number of larger parts; may count one of them more than once
};

PartsOutside parts_up_to(double limit, Outside outside, std::span<const Index> rim,
                         const Topology& topology, std::span<const Vector3d> positions) {
  PartsOutside parts;
  enum : char { unknown, known, larger };  // the disk and whole parts are known
  std::vector<char> state = vertex_mask(topology.vertex_count(), outside.inside());
  for (const Index start : rim) {
    double area = 0.0;
    std::vector<Index> vertices;
    outside.spread({&start, 1}, [&](Index v) {
      area += area_of(v, topology, positions);
      vertices.push_back(v);
      state[v] = known;
      return area <= limit;
    });
    if (vertices.empty()) continue;
    const auto has_beside = [&](char which) {
      return std::ranges::any_of(vertices, [&](Index v) {
        return std::ranges::any_of(topology.rings[v], [&](Index w) { return state[w] == which; });
      });
    };
    // A visit also ends if it meets an earlier visit of the same part that stopped at the limit.
    if (area <= limit && !has_beside(unknown) && !has_beside(larger)) {
      parts.largest = std::max(parts.largest, area);
      parts.whole.emplace_back(area, std::move(vertices));
      continue;
    }
    if (area > limit && !has_beside(larger)) ++parts.larger;
    for (const Index v : vertices) state[v] = larger;
  }
  return parts;
}

// Returns the vertices of the parts into which the disk divides the rest of its component, without
// the largest part and those that are nearly as large.
VertexSet parts_cut_off(double radius, const GeodesicFront& front, const Topology& topology,
                        std::span<const Vector3d> positions) {
  Outside outside(front, topology, radius);
  const std::vector<Index> rim = outside.rim();
  if (rim.empty()) return {};
  // If the rim is connected, so is the rest, which then need not be visited.
  std::size_t on_rim = 0;
  Outside(outside).spread(
      std::span(rim).first(1), [&](Index) { return ++on_rim > 0; }, rim);
  if (on_rim == rim.size()) return {};
  // Visiting the largest part would take time proportional to the mesh. Raise the limit until only
  // one part is larger, and it is so much larger that its exact area does not matter.
  double limit = 0.0;
  for (const Index v : outside.inside()) limit += area_of(v, topology, positions);
  while (true) {
    const PartsOutside parts = parts_up_to(limit, outside, rim, topology, positions);
    const bool is_certain =
        parts.larger == 0 || (parts.larger == 1 && parts.largest < kCutOff * limit);
    if (!is_certain) {
      limit *= 2.0;
      continue;
    }
    VertexSet cut_off;
    for (const auto& [area, vertices] : parts.whole) {
      if (parts.larger == 0 && area >= kCutOff * parts.largest) continue;
      cut_off.insert(cut_off.end(), vertices.begin(), vertices.end());
    }
    std::ranges::sort(cut_off);
    return cut_off;
  }
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
  GeodesicFront front(topology, positions, {&center, 1});
  std::vector<double> lengths;
  // Most of a large mesh is never visited if no limb begins near the vertex.
  double largest = kWithoutLimb + kShortestLimb;
  const auto measure = [&] {
    front.march_to(largest * brush);
    measure_circles(lengths, front, topology, positions, brush, largest);
  };
  for (measure(); largest < kLargest && may_go_on(lengths); measure()) largest += 1.0;
  const std::optional<std::size_t> limb = end_of_limb(lengths);
  GrabRegion region;
  region.is_limb = limb.has_value();
  const double radius = factor * brush * (limb ? radius_of(*limb) : kWithoutLimb);
  front.march_to(std::max(radius, largest * brush));
  region.radius = limited_to_half(radius, front, topology, positions);
  region.cut_off = parts_cut_off(region.radius, front, topology, positions);
  for (const Index v : front.reached()) {
    if (front.distances()[v] <= region.radius) region.vertices.push_back(v);
  }
  region.vertices.insert(region.vertices.end(), region.cut_off.begin(), region.cut_off.end());
  std::ranges::sort(region.vertices);
  return region;
}

}  // namespace lapwing
