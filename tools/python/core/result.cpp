#include "result.h"

#include <algorithm>
#include <pybind11/stl.h>
#include <tuple>

#include "arrays.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/run/run_report.h"
#include "messages.h"
#include "module.h"
#include "pickle.h"

namespace lapwing::python {
namespace {

VertexMotion motion_of(const Result& result) {
  const py::gil_scoped_release unlocked;
  return vertex_motion(result.rest, result.mesh.positions, result.mesh.topology());
}

py::array_t<double> rotations_of(const Result& result) {
  const VertexMotion motion = motion_of(result);
  py::array_t<double> array(
      {static_cast<py::ssize_t>(motion.rotations.size()), py::ssize_t{3}, py::ssize_t{3}});
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  double* to = array.mutable_data();
  for (const Eigen::Quaterniond& q : motion.rotations) {
    const Rows rotation = q.toRotationMatrix();
    to = std::copy(rotation.data(), rotation.data() + 9, to);
  }
  return array;
}

py::array_t<double> displacements_of(const Result& result) {
  Positions differences = result.mesh.positions;
  for (std::size_t v = 0; v < differences.size(); ++v) differences[v] -= result.rest[v];
  return array_of(differences);
}

py::list handles_of(const Result& result) {
  py::list handles;
  for (const VertexSet& handle : result.handles) handles.append(array_of(handle));
  return handles;
}

std::string repr_of(const Result& result) {
  std::string text = "Result(" + std::to_string(result.mesh.vertex_count()) + " vertices, " +
                     std::to_string(result.mesh.face_count()) + " faces";
  if (result.certificate && !result.certificate->settled) text += ", not settled";
  const std::size_t warnings = result.warnings.size();
  if (warnings > 0)
    text += ", " + std::to_string(warnings) + (warnings == 1 ? " warning" : " warnings");
  return text + ")";
}

py::tuple state_of(const Result& result) {
  py::list handles;
  for (const VertexSet& handle : result.handles) handles.append(pack(handle));
  return py::make_tuple(pack(result.mesh), pack(result.rest), pack(result.roi), pack(result.belt),
                        handles, result.certificate, result.warnings, result.notes,
                        result.report_json);
}

Result result_of(const py::tuple& state) {
  Result result;
  result.mesh = unpack_mesh(state[0].cast<py::tuple>());
  unpack(state[1], result.rest);
  unpack(state[2], result.roi);
  unpack(state[3], result.belt);
  for (const py::handle& handle : state[4]) unpack(handle, result.handles.emplace_back());
  result.certificate = state[5].cast<std::optional<Certificate>>();
  result.warnings = state[6].cast<std::vector<std::string>>();
  result.notes = state[7].cast<std::vector<std::string>>();
  result.report_json = state[8].cast<std::string>();
  return result;
}

// Returns references to the members of a certificate that are attributes in Python.
template <class Of>
auto members_of(Of& c) {
  return std::tie(c.settled, c.settle_iterations, c.settle_last_step, c.relative_gradient,
                  c.relative_residual, c.handle_error, c.target_error, c.detail_error,
                  c.edge_stretch, c.largest_edge_stretch, c.largest_edge_stretch_vertices,
                  c.smallest_scale, c.largest_scale, c.smallest_scale_vertex,
                  c.largest_scale_vertex, c.largest_rotation_degrees, c.largest_rotation_vertex,
                  c.flipped_triangles, c.inside_out_share, c.first_flipped_triangles);
}

py::tuple certificate_state(const Certificate& c) {
  return std::apply([](const auto&... members) { return py::make_tuple(members...); },
                    members_of(c));
}

Certificate certificate_of(const py::tuple& state) {
  Certificate certificate;
  std::apply(
      [&](auto&... members) {
        std::size_t k = 0;
        ((members = state[k++].template cast<std::decay_t<decltype(members)>>()), ...);
      },
      members_of(certificate));
  return certificate;
}

py::object vertex_or_none(Index v) {
  return v == kNoIndex ? py::object(py::none()) : py::object(py::int_(v));
}

// Returns a member of a certificate that is a vertex, or None if the vertex is not set.
template <Index Certificate::*Member>
py::object vertex(const Certificate& c) {
  return vertex_or_none(c.*Member);
}

void add_certificate(py::module_& module) {
  using C = Certificate;
  py::class_<C> type(module, "Certificate",
                     "The quality of a deformed surface, measured on the surface itself.");
  add_copies(type);
  type.def(py::pickle(&certificate_state, &certificate_of))
      .def_readonly("settled", &C::settled, "False if the iterations ended first.")
      .def_readonly("settle_iterations", &C::settle_iterations)
      .def_readonly("settle_last_step", &C::settle_last_step,
                    "How far a vertex would still move, in mean edge lengths.")
      .def_readonly("relative_gradient", &C::relative_gradient,
                    "Forces that are not in balance, relative to the force of the handles.")
      .def_readonly("relative_residual", &C::relative_residual,
                    "Residual of the linear response, if the edit does not settle.")
      .def_readonly("handle_error", &C::handle_error,
                    "Largest distance of a handle vertex from its prescribed position.")
      .def_readonly("target_error", &C::target_error,
                    "Largest distance of a target's point from its prescribed position.")
      .def_readonly(
          "detail_error", &C::detail_error,
          "Change of the details' shapes, relative to their size; 0 is no loss, NaN if the "
          "surface has no details.")
      .def_readonly("edge_stretch", &C::edge_stretch,
                    "Root mean square of the relative change of edge lengths.")
      .def_readonly("largest_edge_stretch", &C::largest_edge_stretch)
      .def_property_readonly(
          "largest_edge_stretch_vertices",
          [](const C& c) {
            return py::make_tuple(vertex_or_none(c.largest_edge_stretch_vertices[0]),
                                  vertex_or_none(c.largest_edge_stretch_vertices[1]));
          },
          "The ends of the edge that changed most.")
      .def_readonly("smallest_scale", &C::smallest_scale,
                    "Smallest scale of the best similarity of a ring; 1 is no change of size.")
      .def_readonly("largest_scale", &C::largest_scale)
      .def_property_readonly("smallest_scale_vertex", &vertex<&C::smallest_scale_vertex>)
      .def_property_readonly("largest_scale_vertex", &vertex<&C::largest_scale_vertex>)
      .def_readonly("largest_rotation_degrees", &C::largest_rotation_degrees,
                    "Largest rotation of a ring, 0 to 180.")
      .def_property_readonly("largest_rotation_vertex", &vertex<&C::largest_rotation_vertex>)
      .def_readonly("flipped_triangles", &C::flipped_triangles)
      .def_readonly("inside_out_share", &C::inside_out_share,
                    "Share of the region's area that is inside out: 0 to 1.")
      .def_property_readonly(
          "first_flipped_triangles",
          [](const C& c) { return read_only(array_of(c.first_flipped_triangles)); })
      .def("__repr__", [](const C& c) {
        return "Certificate(settled=" + std::string(c.settled ? "True" : "False") +
               ", detail_error=" + std::string(py::repr(py::float_(c.detail_error))) +
               ", edge_stretch=" + std::string(py::repr(py::float_(c.edge_stretch))) +
               ", flipped_triangles=" + std::to_string(c.flipped_triangles) + ")";
      });
}

}  // namespace

Result::Result(Mesh edited, Positions before, EditRegion region, RunReport report)
    : mesh(std::move(edited)),
      rest(std::move(before)),
      roi(std::move(region.roi)),
      belt(std::move(region.belt)),
      handles(std::move(region.handles)) {
  report.warnings = in_python_words(std::move(report.warnings));
  report.notes = in_python_words(std::move(report.notes));
  report_json = to_json(report);
  warnings = std::move(report.warnings);
  notes = std::move(report.notes);
  if (!report.steps.empty() && report.steps.back().deform) {
    certificate = std::move(report.steps.back().deform->certificate);
  }
}

void add_result(py::module_& module) {
  add_certificate(module);
  py::class_<Result> type(
      module, "Result",
      "The result of an edit. `V, F = result` are arrays of your own; the arrays that are "
      "attributes are read-only copies. The bits are kept by `pickle`, but what the mesh's file "
      "has beyond its geometry and attributes is not (see Mesh).");
  add_copies(type);
  type.def(py::pickle(&state_of, &result_of))
      .def(
          "__iter__", [](const Result& r) { return arrays_of(r.mesh); }, "V, F = result")
      .def("__repr__", &repr_of)
      .def_property_readonly(
          "vertices", [](const Result& r) { return read_only(array_of(r.mesh.positions)); },
          "(n, 3) float64, a read-only copy.")
      .def_property_readonly(
          "faces", [](const Result& r) { return read_only(faces_of(r.mesh)); },
          "(m, k) uint32, or a list of arrays if the polygons differ in size. The given faces, "
          "unless the edit made new ones.")
      .def_property_readonly(
          "mesh", [](const Result& r) { return r.mesh; },
          "The Mesh, with texture coordinates and all other data of its file.")
      .def_property_readonly(
          "rotations", [](const Result& r) { return read_only(rotations_of(r)); },
          "(n, 3, 3) float64: the rotation of the ring of each vertex.")
      .def_property_readonly(
          "displacements", [](const Result& r) { return read_only(displacements_of(r)); },
          "(n, 3) float64: the displacement of each vertex.")
      .def_property_readonly(
          "certificate", [](const Result& r) { return r.certificate; },
          "Certificate of the last step, None unless that is a deform.")
      .def_property_readonly(
          "roi", [](const Result& r) { return read_only(array_of(r.roi)); },
          "Vertices of the last step's region, ascending.")
      .def_property_readonly(
          "belt", [](const Result& r) { return read_only(array_of(r.belt)); },
          "Vertices of the region that stay.")
      .def_property_readonly(
          "handles", [](const Result& r) { return read_only(handles_of(r)); },
          "A list of arrays: the vertices of each handle.")
      .def_readonly("warnings", &Result::warnings,
                    "Problems of the result: where they are, and what to change.")
      .def_readonly("notes", &Result::notes,
                    "Actions that no argument asked for. They are no cause for concern.")
      .def_readonly("report_json", &Result::report_json,
                    "A report in JSON: device, warnings, and of each step its measures and times.");
}

}  // namespace lapwing::python
