#pragma once

#include <array>

#include "lapwing/mesh/mesh.h"

namespace lapwing::test {

/// Returns the unit square as one polygon with the material "skin". `uv_of` maps the position of a
/// corner to its texture coordinates.
template <class UvOf>
Mesh textured_square(const UvOf& uv_of) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_face(std::array<Index, 4>{0, 1, 2, 3});
  MeshAttributes& a = mesh.edit_attributes();
  for (const Eigen::Vector3d& p : mesh.positions) a.uvs.push_back(uv_of(p.head<2>()));
  a.corner_uvs = {0, 1, 2, 3};
  a.materials = {"skin"};
  a.face_materials = {0};
  return mesh;
}

/// Returns the unit square with x and y as texture coordinates.
inline Mesh textured_square() {
  return textured_square([](const Eigen::Vector2d& p) -> Eigen::Vector2d { return p; });
}

}  // namespace lapwing::test
