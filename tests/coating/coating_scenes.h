#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

#include "lapwing/coating/coater.h"
#include "lapwing/coating/correspondence.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/region/vertex_set.h"

namespace lapwing::test {

inline VertexSet every_vertex(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

inline VertexSet within(const Mesh& mesh, const Eigen::Vector3d& center, double radius) {
  VertexSet region;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if ((mesh.positions[v] - center).norm() <= radius) region.push_back(v);
  }
  return region;
}

inline Eigen::Affine3d similarity(double scale) {
  return Eigen::Translation3d(3.0, -2.0, 5.0) *
         Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()) * Eigen::Scaling(scale);
}

inline Mesh transformed(Mesh mesh, const Eigen::Affine3d& map) {
  for (Eigen::Vector3d& p : mesh.positions) p = map * p;
  return mesh;
}

/// The unit square with `waves` x `waves` hills and dales of that height.
inline Mesh relief(Index cells, double waves, double height) {
  Mesh mesh = grid(cells, cells);
  const double k = 2.0 * std::numbers::pi * waves;
  for (Eigen::Vector3d& p : mesh.positions) {
    p.z() = height * std::sin(k * p.x()) * std::sin(k * p.y());
  }
  return mesh;
}

/// The same on triangles that are no two alike: vertices moved within their cells by up to a fifth
/// of one, and diagonals that go either way.
inline Mesh uneven_relief(Index cells, double waves, double height, unsigned seed) {
  Mesh mesh = relief(cells, waves, height);
  std::mt19937 generator(seed);
  const double k = 2.0 * std::numbers::pi * waves;
  for (Eigen::Vector3d& p : mesh.positions) {
    const auto moved = [&](double x) {
      const double by = (0.4 * 0x1p-32 * static_cast<double>(generator()) - 0.2) / cells;
      return x > 0.0 && x < 1.0 ? x + by : x;
    };
    p.x() = moved(p.x());
    p.y() = moved(p.y());
    p.z() = height * std::sin(k * p.x()) * std::sin(k * p.y());
  }
  for (Index c = 0; c < cells * cells; ++c) {
    const Index a = c / cells * (cells + 1) + c % cells;
    const Index b = a + 1;
    const Index d = a + cells + 1;
    const Index e = d + 1;
    const std::array<Index, 6> rising{a, b, e, a, e, d};
    const std::array<Index, 6> falling{a, b, d, b, e, d};
    const auto& corners = generator() % 2 == 0 ? rising : falling;
    std::copy(corners.begin(), corners.end(), mesh.edit_faces().vertices.begin() + 6 * c);
  }
  return mesh;
}

/// A mesh with a patch on it.
struct PatchedMesh {
  PatchedMesh(Mesh own_mesh, const VertexSet& region)
      : mesh(std::move(own_mesh)),
        topology(mesh.topology()),
        patch(disk_patch(region, topology, mesh.positions, "patch")),
        own(on_patch<Eigen::Vector3d>(patch, mesh.positions)) {}
  explicit PatchedMesh(const Mesh& whole) : PatchedMesh(whole, every_vertex(whole)) {}
  PlacedPatch placed() const { return {patch, own}; }

  Mesh mesh;
  Topology topology;
  Patch patch;
  std::vector<Eigen::Vector3d> own;
};

inline Coating peel_cotangent(const PatchedMesh& source, double detail_size) {
  CpuKernels kernels;
  return peel_patch(source.patch, source.mesh.positions, source.topology, detail_size,
                    LaplacianWeights::cotangent, kernels);
}

/// The four corners of a grid of `cells` x `cells`, in order around.
inline std::vector<Index> corners(Index cells) {
  const Index row = cells + 1;
  return {0, cells, row * row - 1, cells * row};
}

/// Every vertex of a patch as the place where it comes to lie.
inline std::vector<SurfacePoint> each_to_itself(const Patch& patch) {
  std::vector<SurfacePoint> points;
  for (Index own = 0; own < patch.size(); ++own) points.push_back(SurfacePoint::at_vertex(own));
  return points;
}

}  // namespace lapwing::test
