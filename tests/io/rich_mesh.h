#pragma once

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {

/// The file name and the encoding of a stored mesh.
struct Storage {
  std::string name;
  Encoding encoding = Encoding::ascii;

  friend void PrintTo(const Storage& storage, std::ostream* out) { *out << storage.name; }
};

inline const std::array kStorages{
    Storage{"a.obj", Encoding::ascii},        Storage{"a.off", Encoding::ascii},
    Storage{"a.ply", Encoding::ascii},        Storage{"b.ply", Encoding::little_endian},
    Storage{"c.ply", Encoding::big_endian},   Storage{"a.stl", Encoding::ascii},
    Storage{"b.stl", Encoding::little_endian}};

/// A curved grid of triangles with every kind of attribute. Positions are floats, so that every
/// format can hold them.
inline Mesh rich_mesh() {
  Mesh mesh = grid(4, 4);
  for (auto& p : mesh.positions) p.z() = 0.25 * p.x() * p.x() - 0.5 * p.y();
  MeshAttributes& a = mesh.edit_attributes();
  a.has_vertex_normals = true;
  a.corner_uvs = mesh.face_vertices();
  ExtraAttribute label{"label", "int", 1, {}};
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    a.uvs.emplace_back(mesh.positions[v].head<2>());
    a.normals.emplace_back(0, 0, 1);
    a.vertex_colors.emplace_back(static_cast<float>(v) / 255.0F, 1.0F, 0.0F, 1.0F);
    label.values.push_back(static_cast<double>(v) * 100000.0);
  }
  a.vertex_extras = {label};
  ExtraAttribute quality{"quality", "double", 1, {}};
  for (Index f = 0; f < mesh.face_count(); ++f) {
    a.face_colors.emplace_back(0.2F, static_cast<float>(f) / 255.0F, 1.0F, 1.0F);
    a.face_materials.push_back(f % 2);
    a.face_groups.push_back(f < 3 ? 0 : 1);
    quality.values.push_back(0.1 * f);
  }
  a.face_extras = {quality};
  a.materials = {"wool", "wax"};
  a.groups = {"left arm", "body"};
  a.comments = {"made by a test"};
  return mesh;
}

/// Returns the value of each corner's vertex. The result is independent of the vertex order.
template <class Value>
std::vector<Value> at_corners(const std::vector<Value>& values, const std::vector<Index>& corners) {
  std::vector<Value> result;
  for (const Index c : corners) result.push_back(values.at(c));
  return result;
}

}  // namespace lapwing
