#include "kernels/mapped_sample.h"

#include <cmath>
#include <random>

namespace lapwing::test {
namespace {

RegionRings rings_of(const Sample& sample, std::span<const Index> rows) {
  const Numbers weights(sample.weights.begin(), sample.weights.end());
  return region_rings(sample.topology, sample.mesh.positions, {weights, {}, {}}, rows, {});
}

SurfacePoint point_around(const Sample& sample, Index v, std::mt19937& generator) {
  const auto triangles = sample.topology.vertex_triangles[v];
  if (triangles.empty()) return SurfacePoint::at_vertex(v);
  const Triangle& triangle = sample.topology.triangles[triangles[generator() % triangles.size()]];
  SurfacePoint point;
  point.corners = {triangle[0], triangle[1], triangle[2]};
  constexpr double kUnit = 0x1p-40;
  const double first = static_cast<double>(generator()) * 0x1p-32;
  const double second = static_cast<double>(generator()) * 0x1p-32;
  point.weights[0] = std::floor(first / kUnit) * kUnit;
  point.weights[1] = std::floor(second * (1.0 - point.weights[0]) / kUnit) * kUnit;
  point.weights[2] = 1.0 - point.weights[0] - point.weights[1];
  return point;
}

}  // namespace

std::vector<Eigen::Vector3d> MappedSample::own(std::span<const Eigen::Vector3d> values) const {
  std::vector<Eigen::Vector3d> result;
  for (const Index v : target.vertices) result.push_back(values[v]);
  return result;
}

MappedSample identity_map(const Sample& sample) {
  MappedSample result{rings_of(sample, sample.vertices), {}};
  for (const Index v : result.target.vertices) {
    result.points.push_back(SurfacePoint::at_vertex(v));
  }
  return result;
}

MappedSample shaken_map(const Sample& sample, unsigned seed, unsigned every_nowhere) {
  std::mt19937 generator(seed);
  std::vector<Index> rows = sample.vertices;
  for (std::size_t k = rows.size(); k > 1; --k) std::swap(rows[k - 1], rows[generator() % k]);
  rows.resize((15 * rows.size() + 15) / 16);
  MappedSample result{rings_of(sample, rows), {}};
  for (const Index v : result.target.vertices) {
    const bool nowhere = every_nowhere > 0 && generator() % every_nowhere == 0;
    result.points.push_back(nowhere ? SurfacePoint::nowhere() : point_around(sample, v, generator));
  }
  return result;
}

MappedSample one_ring(const std::vector<bool>& mapped) {
  MappedSample result;
  result.target.vertices.push_back(0);
  result.points.push_back(SurfacePoint::at_vertex(0));
  for (const bool somewhere : mapped) {
    const auto j = static_cast<Index>(result.target.vertices.size());
    result.target.vertices.push_back(j);
    result.target.neighbours.push_back(j);
    result.target.weights.push_back(1.0 / static_cast<double>(mapped.size()));
    result.points.push_back(somewhere ? SurfacePoint::at_vertex(j) : SurfacePoint::nowhere());
  }
  result.target.starts.push_back(static_cast<Index>(mapped.size()));
  return result;
}

}  // namespace lapwing::test
