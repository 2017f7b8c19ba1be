#include "pickle.h"

#include <algorithm>
#include <pybind11/stl.h>
#include <tuple>

namespace lapwing::python {
namespace {

using python::pack;
using python::unpack;

// Packs each string as bytes, because names and comments in a mesh file may be invalid UTF-8.
py::tuple pack(const std::vector<std::string>& lines) {
  py::list packed;
  for (const std::string& line : lines) packed.append(py::bytes(line));
  return py::tuple(packed);
}

void unpack(const py::handle& packed, std::vector<std::string>& lines) {
  for (const py::handle& line : packed) lines.push_back(line.cast<std::string>());
}

py::tuple pack(const std::vector<ExtraAttribute>& extras) {
  py::list packed;
  for (const ExtraAttribute& extra : extras) {
    packed.append(py::make_tuple(py::bytes(extra.name), py::bytes(extra.type), extra.components,
                                 pack(extra.values)));
  }
  return py::tuple(packed);
}

void unpack(const py::handle& packed, std::vector<ExtraAttribute>& extras) {
  for (const py::handle& each : packed) {
    const auto fields = each.cast<py::tuple>();
    ExtraAttribute extra{
        fields[0].cast<std::string>(), fields[1].cast<std::string>(), fields[2].cast<int>(), {}};
    unpack(fields[3], extra.values);
    extras.push_back(std::move(extra));
  }
}

py::bool_ pack(bool value) {
  return py::bool_(value);
}

void unpack(const py::handle& packed, bool& value) {
  value = packed.cast<bool>();
}

// Returns references to all fields. If a field is missing here, the compiler reports an error.
template <class Attributes>
auto fields_of(Attributes& attributes) {
  auto& [uvs, corner_uvs, normals, corner_normals, has_vertex_normals, groups_are_objects,
         vertex_colors, face_colors, material_libraries, materials, face_materials, groups,
         face_groups, comments, vertex_extras, face_extras, uneditable] = attributes;
  return std::tie(uvs, corner_uvs, normals, corner_normals, has_vertex_normals, groups_are_objects,
                  vertex_colors, face_colors, material_libraries, materials, face_materials, groups,
                  face_groups, comments, vertex_extras, face_extras, uneditable);
}

py::tuple pack(const MeshAttributes& attributes) {
  return std::apply([](const auto&... fields) { return py::make_tuple(pack(fields)...); },
                    fields_of(attributes));
}

void unpack(const py::tuple& packed, MeshAttributes& attributes) {
  std::apply(
      [&](auto&... fields) {
        std::size_t k = 0;
        (unpack(packed[k++], fields), ...);
      },
      fields_of(attributes));
}

}  // namespace

py::tuple pack(const Mesh& mesh) {
  return py::make_tuple(pack(mesh.positions), pack(mesh.face_starts()), pack(mesh.face_vertices()),
                        pack(mesh.attributes()));
}

Mesh unpack_mesh(const py::tuple& packed) {
  Mesh mesh;
  unpack(packed[0], mesh.positions);
  Faces& faces = mesh.edit_faces();
  unpack(packed[1], faces.starts);
  unpack(packed[2], faces.vertices);
  const bool rises = std::is_sorted(faces.starts.begin(), faces.starts.end());
  if (!rises || faces.starts.empty() || faces.starts.back() != faces.vertices.size()) {
    throw InputError("the pickle is damaged; make it again");
  }
  validate_indices(mesh);
  unpack(packed[3].cast<py::tuple>(), mesh.edit_attributes());
  return mesh;
}

}  // namespace lapwing::python
