#include <pybind11/stl.h>
#include <string>

#include "arrays.h"
#include "interruptible.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/peel.h"
#include "lapwing/doctor/check.h"
#include "lapwing/doctor/fix.h"
#include "lapwing/fill/fill_holes.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/decimate_mesh.h"
#include "lapwing/mesh/subdivide_mesh.h"
#include "lapwing/parameterize/parameterize.h"
#include "lapwing/recipe/read_values.h"
#include "lapwing/recipe/step.h"
#include "lapwing/region/grab_region.h"
#include "lapwing/remesh/remesh.h"
#include "lapwing/run/run_step.h"
#include "lapwing/transfer/transfer.h"
#include "lapwing/wrap/landmarks.h"
#include "lapwing/wrap/wrap.h"
#include "messages.h"
#include "module.h"

namespace lapwing::python {
namespace {

using namespace py::literals;

RegionSpec region_of(const std::string& json, const std::string& name) {
  return read_region(JsonNode::parse(json, name));
}

py::dict peel_mesh(const Mesh& mesh, const std::string& region, double detail_size,
                   const std::string& weights) {
  PeelRequest request;
  request.region = region_of(region, "peel: region");
  request.detail_size = detail_size;
  request.weights = one_of<LaplacianWeights>(
      "peel: weights", weights,
      {{"uniform", LaplacianWeights::uniform}, {"cotangent", LaplacianWeights::cotangent}});
  const Peeled peeled =
      Interruptible(py::none()).call([&](const Progress&) { return peel(mesh, request); });
  return py::dict("mesh"_a = peeled.mesh, "coating"_a = array_of(peeled.displacement),
                  "moved"_a = array_of(peeled.moved), "mean_coating"_a = peeled.mean_coating,
                  "largest_coating"_a = peeled.largest_coating,
                  "warnings"_a = in_python_words(peeled.warnings));
}

py::dict remesh_mesh(const Mesh& mesh, const std::string& region, std::optional<double> length,
                     double scale, int iterations, double feature_degrees,
                     const py::object& heard) {
  RemeshRequest request;
  request.region = region_of(region, "remesh: region");
  request.length = length;
  request.scale = scale;
  request.options.iterations = iterations;
  request.options.feature_angle_degrees = feature_degrees;
  const Remeshed result = Interruptible(heard).call(
      [&](const Progress& progress) { return remesh(mesh, request, progress); });
  return py::dict("mesh"_a = result.mesh, "kept"_a = array_of(result.kept),
                  "region"_a = array_of(result.region), "mean_edge"_a = result.after.mean_edge,
                  "smallest_angle_degrees"_a = result.after.smallest_angle_degrees,
                  "warnings"_a = in_python_words(result.warnings));
}

py::dict parameterize_mesh(const Mesh& mesh, const std::string& region, const std::string& domain,
                           const std::vector<Index>& pins) {
  ParameterizeRequest request;
  request.region = region_of(region, "parameterize: region");
  request.domain = one_of<Domain>("parameterize: domain", domain,
                                  {{"disk", Domain::disk}, {"square", Domain::square}});
  request.pins = pins;
  const Parameterized result =
      Interruptible(py::none()).call([&](const Progress&) { return parameterize(mesh, request); });
  const Patch& patch = result.patch;
  py::array_t<double> points({static_cast<py::ssize_t>(result.map.points.size()), py::ssize_t{2}});
  double* to = points.mutable_data();
  for (const Eigen::Vector2d& p : result.map.points) to = std::copy(p.data(), p.data() + 2, to);
  py::array_t<Index> triangles({static_cast<py::ssize_t>(patch.triangles.size()), py::ssize_t{3}});
  Index* corner = triangles.mutable_data();
  for (const Triangle& t : patch.triangles) corner = std::copy(t.begin(), t.end(), corner);
  return py::dict("mesh"_a = result.mesh, "points"_a = std::move(points),
                  "patch_vertices"_a = array_of(patch.vertices),
                  "patch_faces"_a = std::move(triangles), "pins"_a = array_of(result.pins),
                  "flipped"_a = array_of(result.flipped), "stretch"_a = result.distortion.stretch,
                  "shear"_a = result.distortion.shear,
                  "warnings"_a = in_python_words(result.warnings));
}

py::dict grab_region_of(const Mesh& mesh, Index vertex, double radius, double factor) {
  const GrabRegion grab = Interruptible(py::none()).call([&](const Progress&) {
    return grab_region(mesh.topology(), mesh.positions, vertex, radius, factor);
  });
  return py::dict("vertices"_a = array_of(grab.vertices), "radius"_a = grab.radius,
                  "is_limb"_a = grab.is_limb);
}

py::dict dict_of(const SurfaceDistance& distance) {
  return py::dict("mean"_a = distance.mean, "percentile_95"_a = distance.percentile_95,
                  "max"_a = distance.max);
}

py::dict wrap_mesh(const Mesh& mesh, const Mesh& scan, const std::string& step_json,
                   const py::object& heard) {
  std::vector<std::string> notes;
  const Wrapped result = Interruptible(heard).call([&](const Progress& progress) {
    const auto step = std::get<WrapStep>(read_step(JsonNode::parse(step_json, "wrap")));
    const LandmarkSpec landmarks = with_rows(step.landmarks, {}, notes);
    CpuKernels kernels;
    return wrap(mesh, scan, wrap_request(step, landmarks, mesh, scan), kernels, progress);
  });
  Mesh wrapped = mesh;
  wrapped.positions = result.positions;
  const WrapReport& report = result.report;
  return py::dict(
      "mesh"_a = std::move(wrapped), "coverage"_a = report.coverage,
      "to_scan"_a = dict_of(report.to_scan), "to_template"_a = dict_of(report.to_template),
      "landmark_error"_a = report.landmark_error, "scale"_a = report.alignment.scale,
      "flipped_triangles"_a = report.flipped_triangles, "edge_stretch"_a = report.edge_stretch,
      "steps"_a = report.steps, "trouble"_a = why_failed(report, mesh.topology().triangles.size()),
      "notes"_a = in_python_words(notes));
}

// `correspondence` contains the positions of the target's vertices on the source, or is None.
py::dict transfer_poses(const Mesh& source, const py::list& poses, const Mesh& target,
                        const std::string& landmarks, const py::object& correspondence,
                        const std::optional<std::string>& held, bool aligned,
                        const py::object& heard) {
  TransferRequest request{.aligned = aligned};
  std::vector<std::string> notes;
  request.landmarks = targets_of(
      with_rows(read_landmarks(JsonNode::parse(landmarks, "transfer: landmarks")), {}, notes),
      target, source);
  if (held) request.held = region_of(*held, "transfer: held");
  if (!correspondence.is_none()) {
    request.on_source = positions_of(correspondence, target.vertex_count());
  }
  std::vector<Positions> posed;
  for (const py::handle pose : poses) {
    posed.push_back(positions_of(py::reinterpret_borrow<py::object>(pose), source.vertex_count()));
    require_pose(source, posed.back(), "transfer: poses[" + std::to_string(posed.size() - 1) + "]");
  }
  Interruptible interruptible(heard);
  std::optional<TransferSolver> solver;
  std::vector<Transferred> results;
  interruptible.call([&](const Progress& progress) {
    CpuKernels kernels;
    solver.emplace(source, target, request, kernels, progress);
    for (const Positions& pose : posed) results.push_back(solver->solve(pose));
  });
  py::list vertices;
  std::vector<double> rotations;
  std::vector<double> stretches;
  std::vector<double> inside_out;
  std::vector<std::size_t> flipped;
  for (const Transferred& result : results) {
    vertices.append(array_of(result.positions));
    rotations.push_back(result.report.largest_rotation_degrees);
    stretches.push_back(result.report.edge_stretch);
    inside_out.push_back(result.report.inside_out_share);
    flipped.push_back(result.report.flipped_triangles);
  }
  return py::dict("vertices"_a = vertices, "unmatched_area"_a = solver->unmatched_area(),
                  "largest_rotation_degrees"_a = rotations, "edge_stretch"_a = stretches,
                  "flipped_triangles"_a = flipped, "inside_out_share"_a = inside_out,
                  "warnings"_a = solver->warnings(), "notes"_a = in_python_words(notes));
}

const char* word_of(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "info";
}

const char* word_of(Element element) {
  switch (element) {
    case Element::vertex:
      return "vertex";
    case Element::face:
      return "face";
    case Element::edge:
      return "edge";
    case Element::component:
      return "component";
    case Element::rim:
      return "rim";
    case Element::none:
      break;
  }
  return "mesh";
}

py::dict dict_of(const MeshStatistics& s) {
  return py::dict("vertices"_a = s.vertices, "faces"_a = s.faces, "triangles"_a = s.triangles,
                  "edges"_a = s.edges, "boundary_edges"_a = s.boundary_edges,
                  "boundary_loops"_a = s.boundary_loops, "component_sizes"_a = s.component_sizes,
                  "euler_characteristic"_a = s.euler_characteristic, "genus"_a = s.genus,
                  "min_edge_length"_a = s.min_edge_length,
                  "mean_edge_length"_a = s.mean_edge_length,
                  "max_edge_length"_a = s.max_edge_length, "area"_a = s.area,
                  "bounds"_a = array_of(std::vector<Eigen::Vector3d>{s.bounds.min, s.bounds.max}));
}

py::dict check_mesh(const Mesh& mesh, bool self_intersections, std::size_t most_listed) {
  const CheckReport report = Interruptible(py::none()).call([&](const Progress&) {
    CheckReport found = check(mesh, most_listed);
    if (self_intersections) add_self_intersections(mesh, found);
    return found;
  });
  py::list defects;
  for (const Defect& defect : report.defects) {
    const DefectInfo& info = describe(defect.kind);
    defects.append(py::dict("kind"_a = info.key, "name"_a = info.name, "count"_a = defect.count,
                            "severity"_a = word_of(info.severity),
                            "meaning"_a = in_python_words(std::string(info.meaning)),
                            "next_step"_a = in_python_words(std::string(info.next_step)),
                            "element"_a = word_of(info.element), "first"_a = array_of(defect.first),
                            "fixable"_a = info.fixable));
  }
  py::list holes;
  for (const Hole& hole : report.holes) {
    holes.append(py::dict("rim"_a = array_of(hole.rim), "perimeter"_a = hole.perimeter,
                          "is_border"_a = hole.is_border,
                          "trouble"_a = in_python_words(hole.trouble)));
  }
  return py::dict("defects"_a = std::move(defects), "holes"_a = std::move(holes),
                  "statistics"_a = dict_of(report.statistics),
                  "has_problems"_a = report.has_problems(), "is_fixable"_a = report.is_fixable());
}

py::dict fix_mesh(const Mesh& mesh) {
  Mesh fixed = mesh;
  const FixReport report =
      Interruptible(py::none()).call([&](const Progress&) { return fix(fixed); });
  py::dict repairs;
  for (const Repair& repair : report.repairs) {
    repairs[py::str(std::string(describe(repair.kind).key))] = repair.count;
  }
  std::vector<Index> sources = report.vertex_sources;
  return py::dict("mesh"_a = std::move(fixed), "repairs"_a = std::move(repairs),
                  "vertex_sources"_a = array_of(sources));
}

py::dict fill_mesh_holes(const Mesh& mesh, const std::string& region, const std::string& shape,
                         int largest, bool borders, const py::object& heard) {
  FillRequest request;
  request.region = region_of(region, "fill_holes: region");
  request.shape = one_of<FillShape>("fill_holes: shape", shape,
                                    {{"flat", FillShape::flat}, {"smooth", FillShape::smooth}});
  request.largest = largest;
  request.borders = borders;
  const FilledHoles result = Interruptible(heard).call(
      [&](const Progress& progress) { return fill_holes(mesh, request, progress); });
  return py::dict("mesh"_a = result.mesh, "holes"_a = result.holes,
                  "new_vertices"_a = result.vertices, "new_faces"_a = result.faces,
                  "warnings"_a = in_python_words(result.warnings));
}

py::dict decimate_mesh(const Mesh& mesh, double share, const py::object& heard) {
  const DecimatedMesh result = Interruptible(heard).call(
      [&](const Progress& progress) { return decimate(mesh, {.share = share}, progress); });
  return py::dict("mesh"_a = result.mesh, "kept"_a = array_of(result.kept));
}

py::dict subdivide_mesh(const Mesh& mesh, int times, bool smooth, const py::object& heard) {
  return py::dict("mesh"_a = Interruptible(heard).call([&](const Progress& progress) {
    return subdivide(mesh, {.times = times, .smooth = smooth}, progress);
  }));
}

}  // namespace

void add_mesh_operations(py::module_& module) {
  module.def("peel", &peel_mesh, "mesh"_a, "region"_a, "detail_size"_a, "weights"_a);
  module.def("remesh", &remesh_mesh, "mesh"_a, "region"_a, "length"_a, "scale"_a, "iterations"_a,
             "feature_degrees"_a, "progress"_a);
  module.def("parameterize", &parameterize_mesh, "mesh"_a, "region"_a, "domain"_a, "pins"_a);
  module.def("wrap", &wrap_mesh, "mesh"_a, "scan"_a, "step"_a, "progress"_a);
  module.def("transfer", &transfer_poses, "source"_a, "poses"_a, "target"_a, "landmarks"_a,
             "correspondence"_a, "held"_a, "aligned"_a, "progress"_a);
  module.def("grab_region", &grab_region_of, "mesh"_a, "vertex"_a, "radius"_a, "factor"_a);
  module.def("check", &check_mesh, "mesh"_a, "self_intersections"_a, "most_listed"_a);
  module.def("fix", &fix_mesh, "mesh"_a);
  module.def("fill_holes", &fill_mesh_holes, "mesh"_a, "region"_a, "shape"_a, "largest"_a,
             "borders"_a, "progress"_a);
  module.def("decimate", &decimate_mesh, "mesh"_a, "share"_a, "progress"_a);
  module.def("subdivide", &subdivide_mesh, "mesh"_a, "times"_a, "smooth"_a, "progress"_a);
}

}  // namespace lapwing::python
