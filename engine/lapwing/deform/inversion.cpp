#include "lapwing/deform/inversion.h"

#include <algorithm>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/mesh/closest_point.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostVertices = 4096;

// Returns the sum of the normals of the triangles around `v`, each of length twice the area.
Vector3d area_normal_at(Index v, const Topology& topology, std::span<const Vector3d> p) {
  Vector3d sum = Vector3d::Zero();
  for (const Index t : topology.vertex_triangles[v]) {
    const auto& [a, b, c] = topology.triangles[t];
    sum += (p[b] - p[a]).cross(p[c] - p[a]);
  }
  return sum;
}

// Returns the triangles with a corner in `roi`, ascending.
std::vector<Index> triangles_at(std::span<const Index> roi, const Topology& topology) {
  std::vector<Index> triangles;
  for (const Index v : roi) {
    const auto around = topology.vertex_triangles[v];
    triangles.insert(triangles.end(), around.begin(), around.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

}  // namespace

Inversion measure_inversion(std::span<const Index> roi, const Topology& topology,
                            std::span<const Vector3d> rest, std::span<const Vector3d> current) {
  Adjacency region;
  region.values = triangles_at(roi, topology);
  if (region.values.empty()) return {};
  region.starts = {0, static_cast<Index>(region.values.size())};
  const ClosestPoint tree(topology.triangles, rest, region);
  const std::size_t stride = (roi.size() + kMostVertices - 1) / kMostVertices;
  struct Sample {
    double area = 0.0;  // 0 without an opposite side
    bool is_inverted = false;
  };
  std::vector<Sample> samples((roi.size() + stride - 1) / stride);
  constexpr std::size_t kSamplesPerTask = 64;
  parallel_for(samples.size(), kSamplesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const Index v = roi[s * stride];
      const Vector3d normal = area_normal_at(v, topology, rest);
      if (normal.isZero(0.0)) continue;
      const TrianglePoint opposite = tree.first_exit(0, rest[v], -normal, rest[v]);
      if (opposite.triangle == kNoIndex) continue;
      Vector3d there = Vector3d::Zero();
      for (std::size_t k = 0; k < 3; ++k) {
        there += opposite.weights[k] * current[topology.triangles[opposite.triangle][k]];
      }
      samples[s] = {normal.norm(),
                    (there - current[v]).dot(area_normal_at(v, topology, current)) > 0.0};
    }
  });
  double all = 0.0;
  double inverted = 0.0;
  std::vector<std::size_t> places;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    all += samples[s].area;
    if (!samples[s].is_inverted) continue;
    inverted += samples[s].area;
    places.push_back(s);
  }
  if (places.empty()) return {};
  // Returns the inverted vertex that is nearest to the mean of all inverted vertices.
  Vector3d mean = Vector3d::Zero();
  for (const std::size_t s : places) mean += current[roi[s * stride]];
  mean /= static_cast<double>(places.size());
  const auto distance = [&](std::size_t s) { return (current[roi[s * stride]] - mean).norm(); };
  const std::size_t middle =
      *std::ranges::min_element(places, {}, [&](std::size_t s) { return distance(s); });
  return {inverted / all, roi[middle * stride]};
}

}  // namespace lapwing
