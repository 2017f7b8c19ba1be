#pragma once

#include <algorithm>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/remesh/remesh.h"
#include "lapwing/wrap/wrap.h"

namespace lapwing::test {

/// A scan of a deformed mesh, with the position of each vertex of the mesh on it.
struct KnownScan {
  Mesh scan;
  Positions places;
};

/// Bends the mesh by 25 degrees, stretches it along the axes, remeshes it and moves it away.
inline KnownScan known_scan(const Mesh& mesh, double remesh_scale) {
  using Eigen::Vector3d;
  const double size = bounds_of(mesh.positions).diagonal();
  std::vector<Index> by_height(mesh.vertex_count());
  std::iota(by_height.begin(), by_height.end(), Index{0});
  std::ranges::sort(by_height, {}, [&](Index v) { return mesh.positions[v].y(); });
  const std::size_t held = by_height.size() / 20;
  EditRegion region;
  region.roi = make_vertex_set(by_height);
  region.belt = make_vertex_set({by_height.begin(), by_height.begin() + held});
  region.handles = {make_vertex_set({by_height.end() - held, by_height.end()})};
  Vector3d top = Vector3d::Zero();
  for (const Index v : region.handles[0]) {
    top += mesh.positions[v] / static_cast<double>(held);
  }
  const Eigen::Affine3d lean = Eigen::Translation3d(top + 0.12 * size * Vector3d(1.0, 0.0, 0.3)) *
                               Eigen::AngleAxisd(-0.44, Vector3d::UnitZ()) *
                               Eigen::Translation3d(-top);
  CpuKernels kernels;
  const DeformSolver solver(mesh.positions, mesh.topology(), region, {}, kernels);
  Mesh leaned = mesh;
  leaned.positions = solver.solve(std::array{lean}).positions;
  for (Vector3d& p : leaned.positions) p = p.cwiseProduct(Vector3d(1.12, 0.95, 1.05));
  KnownScan known{
      remesh(leaned, {.region = {ListedVertices{region.roi}, "all"}, .scale = remesh_scale}).mesh,
      leaned.positions};
  const Eigen::Affine3d away = Eigen::Translation3d(2.0 * size, size, -size) *
                               Eigen::AngleAxisd(1.0, Vector3d(1, 2, 3).normalized()) *
                               Eigen::Scaling(1.7);
  for (Vector3d& p : known.scan.positions) p = away * p;
  for (Vector3d& p : known.places) p = away * p;
  return known;
}

/// Returns `count` vertices that are far from each other.
inline std::vector<Index> spread_vertices(const Positions& positions, std::size_t count) {
  std::vector<double> distances(positions.size(), std::numeric_limits<double>::infinity());
  std::vector<Index> chosen{0};
  while (chosen.size() < count) {
    for (Index v = 0; v < positions.size(); ++v) {
      const double distance = (positions[v] - positions[chosen.back()]).norm();
      distances[v] = std::min(distances[v], distance);
    }
    chosen.push_back(static_cast<Index>(std::ranges::max_element(distances) - distances.begin()));
  }
  return chosen;
}

inline TargetSpec landmarks_at(std::span<const Index> vertices, const Positions& places) {
  TargetSpec landmarks{.where = "landmarks"};
  for (const Index v : vertices) landmarks.rows.push_back({.point = v, .position = places[v]});
  return landmarks;
}

/// Returns the mean distance of corresponding points, over the diagonal of `b`.
inline double mean_error(const Positions& a, const Positions& b) {
  double sum = 0.0;
  for (std::size_t v = 0; v < a.size(); ++v) sum += (a[v] - b[v]).norm();
  return sum / static_cast<double>(a.size()) / bounds_of(b).diagonal();
}

}  // namespace lapwing::test
