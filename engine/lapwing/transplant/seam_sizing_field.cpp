#include "lapwing/transplant/seam_sizing_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/Geometry>

#include "lapwing/remesh/isotropic.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// Returns the points of both loops, indexed like the corners of Bridge::triangles.
std::vector<Vector3d> corners_of(std::span<const Vector3d> host, std::span<const Vector3d> part) {
  std::vector<Vector3d> corners(host.begin(), host.end());
  corners.insert(corners.end(), part.begin(), part.end());
  return corners;
}

double mean_side(std::span<const Vector3d> loop) {
  double sum = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    sum += (loop[(k + 1) % loop.size()] - loop[k]).norm();
  }
  return sum / static_cast<double>(loop.size());
}

double smallest_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const auto angle = [](const Vector3d& u, const Vector3d& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
  };
  return std::min({angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c)});
}

// Returns the mean length of the edges from `v` to the finite neighbours for which `counts` returns
// true.
template <class Counts>
double mean_ring_edge(Index v, const Topology& topology, std::span<const Vector3d> positions,
                      const Counts& counts) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Index j : topology.rings[v]) {
    if (!counts(j) || !positions[j].allFinite()) continue;
    sum += (positions[j] - positions[v]).norm();
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double mean(std::span<const double> values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

double strip_width(const Bridge& bridge, std::span<const Vector3d> host,
                   std::span<const Vector3d> part) {
  const std::vector<Vector3d> corners = corners_of(host, part);
  double sum = 0.0;
  std::size_t count = bridge.welded.size();
  for (const Triangle& t : bridge.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k];
      const Index b = t[(k + 1) % 3];
      if ((a < host.size()) == (b < host.size())) continue;
      sum += (corners[a] - corners[b]).norm();
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

bool is_even(const Bridge& bridge, std::span<const Vector3d> host, std::span<const Vector3d> part) {
  constexpr double kSliver = 15.0 * std::numbers::pi / 180.0;
  constexpr double kMostSlivers = 0.1;
  constexpr double kWidest = 2.0;
  const std::vector<Vector3d> corners = corners_of(host, part);
  const auto slivers =
      std::count_if(bridge.triangles.begin(), bridge.triangles.end(), [&](const auto& t) {
        return smallest_angle(corners[t[0]], corners[t[1]], corners[t[2]]) < kSliver;
      });
  return static_cast<double>(slivers) <=
             kMostSlivers * static_cast<double>(bridge.triangles.size()) &&
         strip_width(bridge, host, part) <= kWidest * std::max(mean_side(host), mean_side(part));
}

SeamSizingField::SeamSizingField(std::span<const Vector3d> positions, const Topology& topology,
                                 std::span<const Index> host_vertices,
                                 std::span<const double> depths, double width)
    : lengths_(positions.size(), 0.0) {
  const auto is_host = [&](Index v) { return host_vertices[v] != kNoIndex; };
  std::vector<double> host_edges;
  std::vector<double> part_edges;
  std::vector<char> in_zone(positions.size(), 0);
  for (Index v = 0; v < positions.size(); ++v) {
    const auto ring = topology.rings[v];
    const bool on_rim =
        is_host(v) && std::any_of(ring.begin(), ring.end(), [&](Index j) { return !is_host(j); });
    if (on_rim) host_edges.push_back(mean_ring_edge(v, topology, positions, is_host));
    const bool on_part = !is_host(v) && !ring.empty() && depths[v] <= width;
    if (!on_rim && !on_part) continue;
    in_zone[v] = 1;
    region_.push_back(v);
    if (on_rim) continue;
    // Exclude the edges of the strip, which belong neither to the part nor to the host.
    lengths_[v] = mean_ring_edge(v, topology, positions, [&](Index j) { return !is_host(j); });
    part_edges.push_back(lengths_[v]);
  }
  host_length_ = mean(host_edges);
  part_length_ = mean(part_edges);
  for (const Index v : region_) {
    const double share = is_host(v) || width <= 0.0 ? 0.0 : depths[v] / width;
    lengths_[v] = (1.0 - share) * host_length_ + share * lengths_[v];
  }
  for (const Triangle& t : topology.triangles) {
    if (in_zone[t[0]] != 0 && in_zone[t[1]] != 0 && in_zone[t[2]] != 0) triangles_.push_back(t);
  }
  if (triangles_.empty()) return;
  closest_.emplace(triangles_, positions);
}

bool SeamSizingField::asks_for_remeshing() const {
  if (host_length_ <= 0.0 || part_length_ <= 0.0) return false;
  return std::max(host_length_, part_length_) > kScaleRatio * std::min(host_length_, part_length_);
}

double SeamSizingField::expected_triangles(std::span<const Vector3d> positions) const {
  double count = 0.0;
  for (const auto& [a, b, c] : triangles_) {
    const double length = (lengths_[a] + lengths_[b] + lengths_[c]) / 3.0;
    count += lapwing::expected_triangles(positions[a], positions[b], positions[c], length);
  }
  return count;
}

double SeamSizingField::operator()(const Vector3d& point) const {
  const TrianglePoint found = closest_->find(0, point);
  const Triangle& corners = triangles_[found.triangle];
  double length = 0.0;
  for (std::size_t k = 0; k < 3; ++k) length += found.weights[k] * lengths_[corners[k]];
  return length;
}

}  // namespace lapwing
