// Based on: Sumner, Popovic, "Deformation transfer for triangle meshes", SIGGRAPH 2004.
#include "lapwing/transfer/pose_maps.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "lapwing/base/parallel.h"
#include "lapwing/laplacian/rotation.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kMapsPerTask = 512;

// If twice the area of a triangle is less than this fraction of its squared longest side, rounding
// errors dominate its map.
constexpr double kFlatTriangle = 1e-10;

// Returns [e1 e2 m].
Matrix3d frame_of(const Triangle& t, std::span<const Vector3d> positions) {
  Matrix3d frame;
  frame.col(0) = positions[t[1]] - positions[t[0]];
  frame.col(1) = positions[t[2]] - positions[t[0]];
  const Vector3d N = frame.col(0).cross(frame.col(1));
  const double length = N.norm();
  frame.col(2) = length > 0.0 ? Vector3d(N / std::sqrt(length)) : Vector3d::Zero();
  return frame;
}

}  // namespace

LinearMap mean_map(const LinearMap& sum) {
  return {nearest_rotation(sum.R), sum.S};
}

std::vector<LinearMap> maps_of_vertices(const Topology& topology, std::span<const double> areas,
                                        std::span<const LinearMap> of_triangle) {
  std::vector<LinearMap> of_vertex(topology.vertex_count());
  parallel_for(of_vertex.size(), kMapsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      double area = 0.0;
      for (const Index t : topology.vertex_triangles[v]) area += areas[t];
      if (!(area > 0.0)) continue;
      for (const Index t : topology.vertex_triangles[v]) {
        if (areas[t] > 0.0) of_vertex[v].add(areas[t] / area, of_triangle[t]);
      }
    }
  });
  return of_vertex;
}

PoseMaps::Rest PoseMaps::prepare(const Topology& topology, std::span<const Vector3d> rest) {
  Rest prepared;
  for (const Triangle& t : topology.triangles) {
    const Matrix3d frame = frame_of(t, rest);
    const double double_area = frame.col(0).cross(frame.col(1)).norm();
    const double longest = std::max({frame.col(0).squaredNorm(), frame.col(1).squaredNorm(),
                                     (frame.col(1) - frame.col(0)).squaredNorm()});
    const bool is_flat = !(double_area > kFlatTriangle * longest);
    prepared.areas.push_back(is_flat ? 0.0 : 0.5 * double_area);
    prepared.inverse_frames.push_back(is_flat ? Matrix3d(Matrix3d::Zero())
                                              : Matrix3d(frame.inverse()));
  }
  return prepared;
}

PoseMaps::PoseMaps(const Topology& topology, const Rest& rest, std::span<const Vector3d> posed)
    : topology_(topology), of_triangle_(topology.triangles.size()) {
  parallel_for(of_triangle_.size(), kMapsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Matrix3d F = frame_of(topology.triangles[t], posed) * rest.inverse_frames[t];
      const Matrix3d R = nearest_rotation(F);
      of_triangle_[t] = {R, R.transpose() * F};
    }
  });
  of_vertex_ = maps_of_vertices(topology, rest.areas, of_triangle_);
}

LinearMap PoseMaps::at(Index triangle, const std::array<double, 3>& weights) const {
  const double least = std::ranges::min(weights);
  LinearMap sum;
  sum.add(3.0 * least, of_triangle_[triangle]);
  for (std::size_t k = 0; k < 3; ++k) {
    sum.add(weights[k] - least, of_vertex_[topology_.triangles[triangle][k]]);
  }
  return mean_map(sum);
}

}  // namespace lapwing
