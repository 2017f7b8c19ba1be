#include "lapwing/mesh/mesh.h"

#include <filesystem>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>
#include <vector>

#include "arrays.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/shapes.h"
#include "module.h"
#include "pickle.h"

namespace lapwing::python {
namespace {

std::vector<std::string> write(const Mesh& mesh, const std::filesystem::path& path,
                               const py::dict& morph_targets) {
  WriteOptions options;
  for (const auto& [name, vertices] : morph_targets) {
    options.morph_targets.push_back(
        {name.cast<std::string>(),
         positions_of(py::reinterpret_borrow<py::object>(vertices), mesh.vertex_count())});
  }
  const py::gil_scoped_release unlocked;
  WriteReport report = write_mesh(mesh, path, options);
  std::vector<std::string> notes;
  for (const std::string& line : report.not_carried) notes.push_back("not carried over: " + line);
  notes.insert(notes.end(), report.notes.begin(), report.notes.end());
  return notes;
}

Mesh read(const std::filesystem::path& path) {
  const Mesh mesh = [&path] {
    const py::gil_scoped_release unlocked;
    return read_mesh(path);
  }();
  for (const std::string& note : reading_notes(mesh)) {
    constexpr Py_ssize_t kCallerOfModule = 2;
    if (PyErr_WarnEx(PyExc_UserWarning, note.c_str(), kCallerOfModule) != 0) {
      throw py::error_already_set();
    }
  }
  return mesh;
}

Mesh with_vertices(Mesh mesh, const py::object& vertices) {
  mesh.positions = positions_of(vertices, mesh.vertex_count());
  return mesh;
}

py::dict morph_targets_of(const Mesh& mesh) {
  py::dict targets;
  for (const MorphTarget& target : read_morph_targets(mesh)) {
    targets[py::str(target.name)] = read_only(array_of(target.positions));
  }
  return targets;
}

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const NamedShape& shape : named_shapes()) names.emplace_back(shape.name);
  return names;
}

Mesh shape(const std::string& name) {
  for (const NamedShape& each : named_shapes()) {
    if (each.name == name) return each.make();
  }
  std::string known;
  for (const std::string& each : shape_names()) known += (known.empty() ? "" : ", ") + each;
  throw InputError("unknown shape \"" + name + "\"; choose one of " + known);
}

}  // namespace

void add_mesh(py::module_& module) {
  py::class_<Mesh> type(
      module, "Mesh",
      "A polygon mesh with all data of its file. It cannot be changed. `V, F = mesh` are arrays "
      "of your own; the arrays that are attributes are read-only copies. A pickle has vertices, "
      "faces, texture coordinates, normals, colours, materials, groups and named attributes. It "
      "does not have the bytes of the file, such as its order and its line elements.");
  add_copies(type);
  type.def(py::pickle([](const Mesh& mesh) { return pack(mesh); }, &unpack_mesh))
      .def(py::init(&mesh_of), py::arg("vertices"), py::arg("faces"))
      .def_property_readonly(
          "vertices", [](const Mesh& mesh) { return read_only(array_of(mesh.positions)); },
          "(n, 3) float64, a read-only copy.")
      .def_property_readonly(
          "faces", [](const Mesh& mesh) { return read_only(faces_of(mesh)); },
          "(m, k) uint32, or a list of arrays if the polygons differ in size.")
      .def_property_readonly(
          "morph_targets", &morph_targets_of,
          "The vertices at the weight 1, by name, for each morph target of a glTF file.")
      .def_property_readonly("vertex_count", &Mesh::vertex_count)
      .def_property_readonly("face_count", &Mesh::face_count)
      .def("__iter__", &arrays_of, "V, F = mesh")
      .def("with_vertices", &with_vertices, py::arg("vertices"),
           "The same mesh in another pose, shape (n, 3).")
      .def("__repr__", [](const Mesh& mesh) {
        return "Mesh(" + std::to_string(mesh.vertex_count()) + " vertices, " +
               std::to_string(mesh.face_count()) + " faces)";
      });
  module.def("read", &read, py::arg("path"));
  module.def("write", &write, py::arg("mesh"), py::arg("path"), py::arg("morph_targets"));
  module.def("shape", &shape, py::arg("name"));
  module.def("shape_names", &shape_names);
}

}  // namespace lapwing::python
