#include "report/number_text.h"
#include "report/report_json.h"
#include "studies/real_report.h"

namespace lapwing::bench {
namespace {

const char* const kFormat = "lapwing-bench real 3";

}  // namespace

// nlohmann::json calls the following functions, which it finds by argument-dependent lookup.

void to_json(Json& json, const RealOutcome& outcome) {
  if (!outcome.measured) {
    json = {{"failure", outcome.failure}};
    return;
  }
  json = {{"settled", outcome.settled},
          {"iterations", outcome.iterations},
          {"flipped_triangles", outcome.flipped_triangles},
          {"largest_edge", six_digits(outcome.largest_edge)},
          {"detail_error", six_digits(outcome.detail_error)},
          {"edge_stretch", six_digits(outcome.edge_stretch)},
          {"constraint_error", six_digits(outcome.constraint_error)},
          {"prepare_ms", six_digits(outcome.prepare_ms)},
          {"solve_ms", six_digits(outcome.solve_ms)}};
}

void from_json(const Json& json, RealOutcome& outcome) {
  outcome.measured = !json.contains("failure");
  if (!outcome.measured) {
    json.at("failure").get_to(outcome.failure);
    return;
  }
  json.at("settled").get_to(outcome.settled);
  json.at("iterations").get_to(outcome.iterations);
  json.at("flipped_triangles").get_to(outcome.flipped_triangles);
  json.at("largest_edge").get_to(outcome.largest_edge);
  json.at("detail_error").get_to(outcome.detail_error);
  json.at("edge_stretch").get_to(outcome.edge_stretch);
  json.at("constraint_error").get_to(outcome.constraint_error);
  json.at("prepare_ms").get_to(outcome.prepare_ms);
  json.at("solve_ms").get_to(outcome.solve_ms);
}

void to_json(Json& json, const RealRun& run) {
  json = {{"mesh", run.mesh},         {"motion", run.motion},
          {"vertices", run.vertices}, {"triangles", run.triangles},
          {"left_out", run.left_out}, {"failure", run.failure},
          {"ours", run.ours},         {"linear", run.linear},
          {"arap", run.arap},         {"smooth_arap", run.smooth_arap}};
}

void from_json(const Json& json, RealRun& run) {
  json.at("mesh").get_to(run.mesh);
  json.at("motion").get_to(run.motion);
  json.at("vertices").get_to(run.vertices);
  json.at("triangles").get_to(run.triangles);
  json.at("left_out").get_to(run.left_out);
  json.at("failure").get_to(run.failure);
  json.at("ours").get_to(run.ours);
  json.at("linear").get_to(run.linear);
  json.at("arap").get_to(run.arap);
  json.at("smooth_arap").get_to(run.smooth_arap);
}

void to_json(Json& json, const Noted& noted) {
  json = {{"run", noted.name}, {"values", noted.why}};
}

void to_json(Json& json, const RealFigure& figure) {
  json = {{"name", figure.name},     {"count", figure.count}, {"of", figure.of},
          {"target", figure.target}, {"met", figure.met()},   {"exceptions", figure.exceptions}};
}

std::string to_json(const RealReport& report) {
  const RealSummary summary = summary_of(report.runs);
  Json passed_over = Json::array();
  for (const Noted& file : report.passed_over) {
    passed_over.push_back({{"mesh", file.name}, {"reason", file.why}});
  }
  return json_by_lines({{"format", kFormat},
                        {"date", report.date},
                        {"commit", report.commit},
                        {"processor", report.processor},
                        {"threads", report.threads},
                        {"seconds", six_digits(report.seconds)},
                        {"runs", report.runs},
                        {"passed_over", passed_over},
                        {"summary",
                         {{"meshes", summary.meshes},
                          {"runs", summary.runs},
                          {"compared", summary.compared},
                          {"figures", summary.figures},
                          {"failures", summary.failures}}}});
}

RealReport parse_real_report(std::string_view json, const std::string& name) {
  const Json root = parse_format(json, kFormat, name);
  return reading_json(name, [&] {
    RealReport report;
    root.at("date").get_to(report.date);
    root.at("commit").get_to(report.commit);
    root.at("processor").get_to(report.processor);
    root.at("threads").get_to(report.threads);
    root.at("seconds").get_to(report.seconds);
    root.at("runs").get_to(report.runs);
    for (const Json& file : root.at("passed_over")) {
      report.passed_over.push_back({file.at("mesh"), file.at("reason")});
    }
    return report;
  });
}

std::string to_json_line(const RealMesh& mesh) {
  const Json json = {{"passed_over", mesh.passed_over}, {"runs", mesh.runs}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

RealMesh parse_real_mesh(std::string_view json) {
  return reading_json("what was measured", [&] {
    const Json root = Json::parse(json);
    return RealMesh{root.at("passed_over"), root.at("runs").get<std::vector<RealRun>>()};
  });
}

}  // namespace lapwing::bench
