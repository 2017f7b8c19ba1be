#include "lapwing/run/run_report.h"

#include <cmath>
#include <cstdio>

#include "lapwing/base/counted.h"
#include "lapwing/run/report_json.h"

namespace lapwing {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json vertex(Index v) {
  return v == kNoIndex ? Json(nullptr) : Json(v);
}

Json edge(const std::array<Index, 2>& ends) {
  return Json::array({vertex(ends[0]), vertex(ends[1])});
}

Json vector(const Eigen::Vector3d& v) {
  return Json::array({number(v.x()), number(v.y()), number(v.z())});
}

// Rounds to microseconds, because further digits are noise.
Json as_json(const StageTimings& timings) {
  Json json = Json::object();
  for (const auto& [stage, ms] : timings.stages()) json[stage] = std::round(ms * 1e3) / 1e3;
  return json;
}

Json as_json(const VertexMeasures& measures) {
  const auto numbers = [](const std::vector<double>& values) {
    Json list = Json::array();
    for (const double value : values) list.push_back(number(value));
    return list;
  };
  Json displacements = Json::array();
  for (const Eigen::Vector3d& d : measures.displacement) displacements.push_back(vector(d));
  Json rotations = Json::array();
  for (const Eigen::Quaterniond& q : measures.rotation) {
    rotations.push_back(Json::array({number(q.w()), number(q.x()), number(q.y()), number(q.z())}));
  }
  return {{"vertices", measures.vertices},
          {"rotation_degrees", numbers(measures.rotation_degrees)},
          {"detail_error", numbers(measures.detail_error)},
          {"stretch", numbers(measures.stretch)},
          {"displacement", std::move(displacements)},
          {"rotation", std::move(rotations)}};
}

Json as_json(const CoatSourceReport& source) {
  return {
      {"source_vertices", source.vertices},      {"pins", source.pins},
      {"flipped_source", source.flipped_source}, {"flipped_target", source.flipped_target},
      {"warp_steps", source.warp_steps},         {"constrained_steps", source.constrained_steps},
      {"mean_scale", number(source.mean_scale)}};
}

// A coat step has one source. Its keys are merged with the other keys.
Json as_json(const CoatReport& coat) {
  Json json = Json::object();
  if (coat.sources.size() == 1) {
    json = as_json(coat.sources.front());
  } else {
    for (const CoatSourceReport& source : coat.sources) json["sources"].push_back(as_json(source));
  }
  json["vertices_before_remeshing"] = coat.vertices_before_remeshing;
  json["transition_width"] = number(coat.transition_width);
  json["relative_residual"] = number(coat.relative_residual);
  json["largest_displacement"] = number(coat.largest_displacement);
  json["largest_displacement_vertex"] = vertex(coat.largest_displacement_vertex);
  return json;
}

Json as_json(const TransplantReport& transplant) {
  Json place = Json::array();
  for (const auto row : transplant.place.rowwise()) {
    for (const double value : row) place.push_back(number(value));
  }
  return {{"part_vertices", transplant.part_vertices},
          {"host_loop", transplant.host_loop},
          {"part_loop", transplant.part_loop},
          {"welded", transplant.welded},
          {"strip_triangles", transplant.strip_triangles},
          {"remeshed_vertices", transplant.remeshed_vertices},
          {"turned", transplant.turned},
          {"place", place},
          {"transition_width", number(transplant.transition_width)},
          {"padding", number(transplant.padding)},
          {"belt", number(transplant.belt)},
          {"flipped", transplant.flipped},
          {"relative_residual", number(transplant.relative_residual)},
          {"last_change", number(transplant.last_change)},
          {"seam_degrees", number(transplant.seam_degrees)},
          {"largest_displacement", number(transplant.largest_displacement)},
          {"largest_displacement_vertex", vertex(transplant.largest_displacement_vertex)}};
}

void append(const StepReport& step, const DeformReport& deform, Json& json) {
  std::size_t handle = 0;
  for (const std::size_t count : step.handles) handle += count;
  json["handle"] = handle;
  json["handles"] = step.handles;
  json["belt"] = step.belt;
  json["solver"] = deform.solver;
  json["turn_degrees"] = number(deform.turn_degrees);
  json["winding_degrees"] =
      deform.winding_degrees ? number(*deform.winding_degrees) : Json(nullptr);
  json["commits"] = deform.commits;
}

Json as_json(const StepReport& step) {
  Json json = {{"op", step.op}, {"roi", step.roi}, {"free", step.free}};
  if (step.deform) {
    append(step, *step.deform, json);
  } else {
    json["belt"] = step.belt;
    if (!step.handles.empty()) json["handles"] = step.handles;
  }
  json["timings_ms"] = as_json(step.timings);
  if (step.deform) json["certificate"] = json_of(step.deform->certificate);
  if (step.coat) json[step.op] = as_json(*step.coat);
  if (step.transplant) json[step.op] = as_json(*step.transplant);
  if (step.peel) {
    json[step.op] = {{"mean_coating", number(step.peel->mean_coating)},
                     {"largest_coating", number(step.peel->largest_coating)}};
  }
  if (step.wrap) json[step.op] = json_of(*step.wrap);
  if (!step.vertices.vertices.empty()) json["vertices"] = as_json(step.vertices);
  return json;
}

Json as_json(const SurfaceDistance& distance) {
  return {{"mean", number(distance.mean)},
          {"percentile_95", number(distance.percentile_95)},
          {"max", number(distance.max)}};
}

const char* word_of(AlignmentMethod method) {
  switch (method) {
    case AlignmentMethod::none:
      return "none";
    case AlignmentMethod::landmarks:
      return "landmarks";
    case AlignmentMethod::surfaces:
      return "surfaces";
  }
  return "";
}

void append_stages(const StageTimings& timings, std::string& text) {
  char line[80];
  for (const auto& [stage, ms] : timings.stages()) {
    std::snprintf(line, sizeof line, "  %-18s %10.2f ms\n", stage.c_str(), ms);
    text += line;
  }
}

}  // namespace

Json json_of(const Certificate& c) {
  return {{"relative_residual", number(c.relative_residual)},
          {"relative_gradient", number(c.relative_gradient)},
          {"handle_error", number(c.handle_error)},
          {"target_error", number(c.target_error)},
          {"smallest_scale", number(c.smallest_scale)},
          {"smallest_scale_vertex", vertex(c.smallest_scale_vertex)},
          {"largest_scale", number(c.largest_scale)},
          {"largest_scale_vertex", vertex(c.largest_scale_vertex)},
          {"largest_rotation_degrees", number(c.largest_rotation_degrees)},
          {"largest_rotation_vertex", vertex(c.largest_rotation_vertex)},
          {"flipped_triangles", c.flipped_triangles},
          {"first_flipped_triangles", c.first_flipped_triangles},
          {"inside_out_share", c.inside_out_share},
          {"detail_error", number(c.detail_error)},
          {"edge_stretch", number(c.edge_stretch)},
          {"largest_edge_stretch", number(c.largest_edge_stretch)},
          {"largest_edge_stretch_vertices", edge(c.largest_edge_stretch_vertices)},
          {"settle_iterations", c.settle_iterations},
          {"settled", c.settled},
          {"settle_last_step", number(c.settle_last_step)},
          {"all_finite", c.all_finite}};
}

Json json_of(const WrapStepReport& wrap) {
  return {{"alignment", word_of(wrap.alignment.method)},
          {"scale", number(wrap.alignment.scale)},
          {"to_scan", as_json(wrap.to_scan)},
          {"to_template", as_json(wrap.to_template)},
          {"scan_diagonal", number(wrap.scan_diagonal)},
          {"coverage", number(wrap.coverage)},
          {"landmark_error", number(wrap.landmark_error)},
          {"flipped_triangles", wrap.flipped_triangles},
          {"self_intersecting_triangles",
           wrap.self_intersecting ? Json(*wrap.self_intersecting) : Json()},
          {"edge_stretch", number(wrap.edge_stretch)},
          {"minimizations", wrap.steps},
          {"trouble", wrap.trouble}};
}

std::string to_json(const RunReport& report) {
  Json json = {
      {"device",
       {{"name", report.device.name},
        {"type", report.device.type},
        {"driver", report.device.driver},
        {"float64", report.device.float64}}},
      {"mesh",
       {{"file", report.mesh},
        {"vertices", report.vertices},
        {"faces", report.faces},
        {"triangles", report.triangles},
        {"components", report.components},
        {"bounds", {{"min", vector(report.bounds.min)}, {"max", vector(report.bounds.max)}}},
        {"diagonal", number(report.bounds.diagonal())}}},
      {"warnings", report.warnings},
      {"notes", report.notes},
      {"timings_ms", as_json(report.timings)},
      {"steps", Json::array()},
      {"peak_memory_bytes", report.peak_memory_bytes}};
  for (const StepReport& step : report.steps) json["steps"].push_back(as_json(step));
  // File names and names inside files are not always UTF-8, but JSON must be.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string format_stages(const RunReport& report) {
  std::string text = "device: " + report.device.name + " (" + report.device.type + ")\n";
  append_stages(report.timings, text);
  for (std::size_t i = 0; i < report.steps.size(); ++i) {
    const StepReport& step = report.steps[i];
    text += "step " + std::to_string(i + 1) + ", " + step.op + ": " +
            counted(step.free, "free vertices");
    if (step.deform) {
      text += ", solver " + step.deform->solver;
      if (step.deform->commits > 1) {
        text += ", " + std::to_string(step.deform->commits) + " commits";
      }
    }
    text += "\n";
    append_stages(step.timings, text);
  }
  return text;
}

}  // namespace lapwing
