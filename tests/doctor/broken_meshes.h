#pragma once

#include <array>
#include <initializer_list>

#include "lapwing/doctor/check.h"
#include "lapwing/mesh/mesh.h"

// Small meshes with one defect each.
namespace lapwing {

inline void add_polygon(Mesh& mesh, std::initializer_list<Index> vertices) {
  mesh.add_face(std::span(vertices.begin(), vertices.size()));
}

/// The unit square as two triangles that do not share vertices: 0 1 2 and 3 4 5, with an unwelded
/// seam along the diagonal (1 = 4 and 2 = 3).
inline Mesh unwelded_square() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {3, 4, 5});
  return mesh;
}

/// Two triangles that touch at vertex 0 alone.
inline Mesh bow_tie() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {0, 3, 4});
  return mesh;
}

/// Three triangles on the edge 0-1.
inline Mesh three_winged_edge() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
  add_polygon(mesh, {0, 1, 2});
  add_polygon(mesh, {0, 1, 3});
  add_polygon(mesh, {0, 1, 4});
  return mesh;
}

/// A Moebius strip of five quads.
inline Mesh moebius_strip() {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    mesh.positions.emplace_back(i, i * i, 0);
    mesh.positions.emplace_back(i, i * i, 1);
  }
  for (Index i = 0; i < 4; ++i) {
    add_polygon(mesh, {2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  add_polygon(mesh, {8, 1, 0, 9});
  return mesh;
}

}  // namespace lapwing
