#include "result.h"

#include <algorithm>
#include <pybind11/stl.h>

#include "arrays.h"
#include "lapwing/deform/vertex_motion.h"
#include "lapwing/session/report.h"

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

py::object certificate_of(const Result& result) {
  const auto& steps = result.report.steps;
  if (steps.empty() || !steps.back().deform) return py::none();
  return py::cast(steps.back().deform->certificate);
}

py::list handles_of(const Result& result) {
  py::list handles;
  for (const VertexSet& handle : result.region.handles) handles.append(array_of(handle));
  return handles;
}

py::object vertex_or_none(Index v) {
  return v == kNoIndex ? py::object(py::none()) : py::object(py::int_(v));
}

// Returns a vertex of a certificate, or None.
template <Index Certificate::*Member>
py::object vertex(const Certificate& c) {
  return vertex_or_none(c.*Member);
}

void add_certificate(py::module_& module) {
  using C = Certificate;
  py::class_<C>(module, "Certificate",
                "The quality of a deformed surface, measured on the surface itself.")
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
      .def_readonly("detail_error", &C::detail_error,
                    "Change of the details' shapes, relative to their size; 0 is no loss.")
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
      .def_property_readonly("first_flipped_triangles",
                             [](const C& c) { return array_of(c.first_flipped_triangles); })
      .def("__repr__", [](const C& c) {
        return "Certificate(settled=" + std::string(c.settled ? "True" : "False") +
               ", detail_error=" + std::string(py::repr(py::float_(c.detail_error))) +
               ", edge_stretch=" + std::string(py::repr(py::float_(c.edge_stretch))) +
               ", flipped_triangles=" + std::to_string(c.flipped_triangles) + ")";
      });
}

}  // namespace

void add_result(py::module_& module) {
  add_certificate(module);
  py::class_<Result>(module, "Result", "The result of an edit.")
      .def_property_readonly(
          "vertices", [](const Result& r) { return array_of(r.mesh.positions); },
          "(n, 3) float64, a new array each time.")
      .def_property_readonly(
          "faces", [](const Result& r) { return faces_of(r.mesh); },
          "(m, k) uint32, or a list of arrays if the polygons differ in size. The given faces, "
          "unless the edit made new ones.")
      .def_property_readonly(
          "mesh", [](const Result& r) { return r.mesh; },
          "The Mesh, with texture coordinates and all other data of its file.")
      .def_property_readonly("rotations", &rotations_of,
                             "(n, 3, 3) float64: the rotation of the ring of each vertex.")
      .def_property_readonly("displacements", &displacements_of,
                             "(n, 3) float64: the displacement of each vertex.")
      .def_property_readonly("certificate", &certificate_of,
                             "Certificate of the last step, None unless that is a deform.")
      .def_property_readonly(
          "roi", [](const Result& r) { return array_of(r.region.roi); },
          "Vertices of the last step's region, ascending.")
      .def_property_readonly("belt", [](const Result& r) { return array_of(r.region.belt); })
      .def_property_readonly("handles", &handles_of, "A list of arrays of vertices.")
      .def_property_readonly(
          "warnings", [](const Result& r) { return r.report.warnings; },
          "Problems of the result: where they are, and what to change.")
      .def_property_readonly(
          "notes", [](const Result& r) { return r.report.notes; },
          "Actions that no argument asked for. They are no cause for concern.")
      .def_property_readonly(
          "report_json", [](const Result& r) { return to_json(r.report); },
          "What `lapwing run --report` writes.");
}

}  // namespace lapwing::python
