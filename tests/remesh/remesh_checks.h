#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "lapwing/mesh/edges.h"
#include "lapwing/remesh/isotropic.h"

namespace lapwing::test {

inline VertexSet every_vertex(const Mesh& mesh) {
  VertexSet all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

inline VertexSet vertices_where(const Mesh& mesh,
                                const std::function<bool(const Eigen::Vector3d&)>& inside) {
  VertexSet chosen;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (inside(mesh.positions[v])) chosen.push_back(v);
  }
  return chosen;
}

inline std::function<double(const Eigen::Vector3d&)> everywhere(double length) {
  return [length](const Eigen::Vector3d&) { return length; };
}

inline RemeshResult remesh_all(const Mesh& mesh, double length, const RemeshOptions& options = {}) {
  return remesh_isotropic(mesh, every_vertex(mesh), everywhere(length), options);
}

/// What remeshing must not change.
struct Shape {
  long euler = 0;
  std::size_t boundary_edges = 0;
  std::size_t boundary_loops = 0;
  std::size_t non_manifold = 0;  ///< edges and vertices
  bool operator==(const Shape&) const = default;
};

inline void PrintTo(const Shape& shape, std::ostream* out) {
  *out << "Euler " << shape.euler << ", boundary " << shape.boundary_edges << " edges in "
       << shape.boundary_loops << " loops, non-manifold " << shape.non_manifold;
}

inline Shape shape_of(const Mesh& mesh) {
  const Edges edges = build_edges(mesh);
  const Fans fans = find_fans(mesh, edges);
  std::vector<char> is_used(mesh.vertex_count(), 0);
  for (const Index v : mesh.face_vertices()) is_used[v] = 1;
  Shape shape;
  shape.euler = std::ranges::count(is_used, 1) - static_cast<long>(edges.count()) +
                static_cast<long>(mesh.face_count());
  for (std::size_t e = 0; e < edges.count(); ++e) {
    shape.boundary_edges += edges.is_boundary(e);
    const auto sides = edges.sides[e];
    const bool agree = sides.size() == 2 && mesh.face_vertices()[sides[0]] ==
                                                mesh.face_vertices()[edges.next_corner[sides[1]]];
    shape.non_manifold += sides.size() > 2 || (sides.size() == 2 && !agree);
  }
  shape.boundary_loops = count_boundary_loops(edges, fans);
  shape.non_manifold += fans.bow_tie_vertices.size();
  return shape;
}

inline Eigen::Vector3d area_vector(const Mesh& mesh, std::size_t f) {
  const auto t = mesh.face(f);
  const Eigen::Vector3d& a = mesh.positions[t[0]];
  return 0.5 * (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a);
}

inline double area(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) sum += area_vector(mesh, f).norm();
  return sum;
}

inline double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    sum += mesh.positions[mesh.face(f)[0]].dot(area_vector(mesh, f)) / 3.0;
  }
  return sum;
}

/// The share of edges with lengths from 0.6 to 1.5 of what is wanted at their middle.
inline double share_of_good_edges(const Mesh& mesh,
                                  const std::function<double(const Eigen::Vector3d&)>& wanted) {
  const Edges edges = build_edges(mesh);
  std::size_t good = 0;
  for (const auto& [a, b] : edges.ends) {
    const Eigen::Vector3d& p = mesh.positions[a];
    const Eigen::Vector3d& q = mesh.positions[b];
    const double ratio = (p - q).norm() / wanted(0.5 * (p + q));
    good += ratio >= 0.6 && ratio <= 1.5;
  }
  return static_cast<double>(good) / static_cast<double>(edges.count());
}

/// Outside the region faces are the same, in the same order, first in the result; vertices that
/// stay are where they were, bit for bit.
inline void expect_outside_unchanged(const Mesh& mesh, const VertexSet& region,
                                     const RemeshResult& result) {
  const std::vector<char> inside = vertex_mask(mesh.vertex_count(), region);
  std::size_t next = 0;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::ranges::all_of(face, [&](Index v) { return inside[v] != 0; })) continue;
    ASSERT_LT(next, result.mesh.face_count());
    std::vector<Index> now;
    for (const Index v : result.mesh.face(next)) now.push_back(result.kept[v]);
    ASSERT_EQ(now, std::vector<Index>(face.begin(), face.end())) << "face " << f;
    ++next;
  }
  ASSERT_EQ(result.kept.size(), result.mesh.vertex_count());
  for (Index v = 0; v < result.kept.size(); ++v) {
    if (result.kept[v] == kNoIndex) continue;
    ASSERT_EQ(result.mesh.positions[v], mesh.positions[result.kept[v]]) << "vertex " << v;
  }
}

}  // namespace lapwing::test
