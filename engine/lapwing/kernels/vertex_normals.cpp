#include <Eigen/Geometry>

#include "lapwing/base/parallel.h"
#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kTrianglesPerTask = 4096;

// Twice the area of a triangle, along its normal.
Vector3d area_vector(std::span<const Vector3d> positions, const Triangle& t) {
  const Vector3d& a = positions[t[0]];
  return (positions[t[1]] - a).cross(positions[t[2]] - a);
}

// Unit normals of `which` where `area_of(t)` is the area vector of triangle t.
template <typename AreaOf>
void normalize_sums(const Adjacency& vertex_triangles, std::span<const Index> which,
                    const AreaOf& area_of, std::span<Vector3d> normals) {
  constexpr std::size_t kVerticesPerTask = 2048;
  parallel_for(which.size(), kVerticesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      Vector3d sum = Vector3d::Zero();
      for (const Index t : vertex_triangles[which[m]]) sum += area_of(t);
      const double length = sum.norm();
      normals[which[m]] = length > 0.0 ? Vector3d(sum / length) : Vector3d::Zero();
    }
  });
}

}  // namespace

void vertex_normals(std::span<const Vector3d> positions, std::span<const Triangle> triangles,
                    const Adjacency& vertex_triangles, std::span<const Index> which,
                    std::span<Vector3d> normals) {
  normalize_sums(
      vertex_triangles, which, [&](Index t) { return area_vector(positions, triangles[t]); },
      normals);
}

void triangle_areas(std::span<const Vector3d> positions, std::span<const Triangle> triangles,
                    std::span<const Index> which, std::span<Vector3d> areas) {
  parallel_for(which.size(), kTrianglesPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t m = begin; m < end; ++m) {
      areas[which[m]] = area_vector(positions, triangles[which[m]]);
    }
  });
}

void vertex_normals(std::span<const Vector3d> areas, const Adjacency& vertex_triangles,
                    std::span<const Index> which, std::span<Vector3d> normals) {
  normalize_sums(
      vertex_triangles, which, [&](Index t) -> const Vector3d& { return areas[t]; }, normals);
}

}  // namespace lapwing
