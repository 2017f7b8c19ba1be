#include "studies/real/real_json.h"

#include <nlohmann/json.hpp>

#include "lapwing/json/json_node.h"
#include "report/number_text.h"
#include "studies/real/real_summary.h"

namespace lapwing::bench {
namespace {

using Json = nlohmann::ordered_json;

const char* const kRealFormat = "lapwing-bench real 2";

// Names of files and messages may contain invalid UTF-8.
std::string in_one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json as_json(const RealOutcome& outcome) {
  if (!outcome.measured) return {{"failure", outcome.failure}};
  return {{"settled", outcome.settled},
          {"iterations", outcome.iterations},
          {"flipped_triangles", outcome.flipped_triangles},
          {"largest_edge", six_digits(outcome.largest_edge)},
          {"detail_error", six_digits(outcome.detail_error)},
          {"edge_stretch", six_digits(outcome.edge_stretch)},
          {"prepare_ms", six_digits(outcome.prepare_ms)},
          {"solve_ms", six_digits(outcome.solve_ms)}};
}

Json as_json(const RealRun& run) {
  return {{"mesh", run.mesh},          {"motion", run.motion},
          {"vertices", run.vertices},  {"triangles", run.triangles},
          {"left_out", run.left_out},  {"failure", run.failure},
          {"ours", as_json(run.ours)}, {"linear", as_json(run.linear)},
          {"arap", as_json(run.arap)}, {"smooth_arap", as_json(run.smooth_arap)}};
}

Json as_json(const PassedOver& file) {
  return {{"mesh", file.mesh}, {"reason", file.reason}};
}

Json as_json(const NotedRun& noted) {
  return {{"run", noted.run}, {"values", noted.values}};
}

Json as_json(const std::vector<NotedRun>& noted) {
  Json list = Json::array();
  for (const NotedRun& one : noted) list.push_back(as_json(one));
  return list;
}

Json as_json(const RealFigure& figure) {
  return {{"name", figure.name}, {"count", figure.count},
          {"of", figure.of},     {"target", figure.target},
          {"met", figure.met()}, {"exceptions", as_json(figure.exceptions)}};
}

Json as_json(const RealSummary& summary) {
  Json figures = Json::array();
  for (const RealFigure& figure : summary.figures) figures.push_back(as_json(figure));
  return {{"meshes", summary.meshes},
          {"runs", summary.runs},
          {"ours", summary.ours},
          {"arap", summary.arap},
          {"compared", summary.compared},
          {"figures", std::move(figures)},
          {"not_run", as_json(summary.not_run)},
          {"ours_failed", as_json(summary.ours_failed)},
          {"arap_failed", as_json(summary.arap_failed)},
          {"smooth_arap_better", as_json(summary.smooth_arap_better)},
          {"smooth_arap_failed", as_json(summary.smooth_arap_failed)}};
}

template <class Item>
std::string list_by_lines(const std::vector<Item>& items) {
  std::string text = "[";
  for (const Item& item : items) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + in_one_line(as_json(item));
  }
  return text + (items.empty() ? "]" : "\n  ]");
}

std::size_t count_at(const JsonNode& node, std::string_view key) {
  return static_cast<std::size_t>(node.at(key).number_from_zero());
}

RealOutcome outcome_of(const JsonNode& node) {
  RealOutcome outcome;
  if (const auto failure = node.find("failure")) {
    node.require_keys({"failure"});
    outcome.failure = failure->string();
    return outcome;
  }
  node.require_keys({"settled", "iterations", "flipped_triangles", "largest_edge", "detail_error",
                     "edge_stretch", "prepare_ms", "solve_ms"});
  outcome.measured = true;
  outcome.settled = node.at("settled").boolean();
  outcome.iterations = static_cast<int>(node.at("iterations").number_from_zero());
  outcome.flipped_triangles = count_at(node, "flipped_triangles");
  outcome.largest_edge = node.at("largest_edge").number_from_zero();
  outcome.detail_error = node.at("detail_error").number_from_zero();
  outcome.edge_stretch = node.at("edge_stretch").number_from_zero();
  outcome.prepare_ms = node.at("prepare_ms").number_from_zero();
  outcome.solve_ms = node.at("solve_ms").number_from_zero();
  return outcome;
}

RealRun run_of(const JsonNode& node) {
  node.require_keys({"mesh", "motion", "vertices", "triangles", "left_out", "failure", "ours",
                     "linear", "arap", "smooth_arap"});
  return {node.at("mesh").string(),    node.at("motion").string(),
          count_at(node, "vertices"),  count_at(node, "triangles"),
          count_at(node, "left_out"),  node.at("failure").string(),
          outcome_of(node.at("ours")), outcome_of(node.at("linear")),
          outcome_of(node.at("arap")), outcome_of(node.at("smooth_arap"))};
}

std::vector<RealRun> runs_of(const JsonNode& node) {
  std::vector<RealRun> runs;
  for (const JsonNode& element : node.elements()) runs.push_back(run_of(element));
  return runs;
}

}  // namespace

std::string to_json(const RealReport& report) {
  std::string text = "{\n  \"format\": " + Json(kRealFormat).dump();
  const auto add = [&](const char* key, const std::string& value) {
    text += ",\n  " + Json(key).dump() + ": " + value;
  };
  add("date", Json(report.date).dump());
  add("commit", Json(report.commit).dump());
  add("processor", Json(report.processor).dump());
  add("threads", Json(report.threads).dump());
  add("seconds", Json(six_digits(report.seconds)).dump());
  add("runs", list_by_lines(report.runs));
  add("passed_over", list_by_lines(report.passed_over));
  add("summary", as_json(summary_of(report.runs)).dump(2));
  return text + "\n}\n";
}

RealReport parse_real_report(std::string_view json, const std::string& name) {
  const JsonNode root = JsonNode::parse(json, name);
  const JsonNode format = root.at("format");
  if (format.string() != kRealFormat) {
    format.fail("this is \"" + format.string() + "\", and what is read here is \"" + kRealFormat +
                "\"; measure again, or use the lapwing-bench that wrote it");
  }
  root.require_keys({"format", "date", "commit", "processor", "threads", "seconds", "runs",
                     "passed_over", "summary"});
  RealReport report;
  report.date = root.at("date").string();
  report.commit = root.at("commit").string();
  report.processor = root.at("processor").string();
  report.threads = static_cast<unsigned>(root.at("threads").number_from_zero());
  report.seconds = root.at("seconds").number_from_zero();
  report.runs = runs_of(root.at("runs"));
  for (const JsonNode& file : root.at("passed_over").elements()) {
    report.passed_over.push_back({file.at("mesh").string(), file.at("reason").string()});
  }
  return report;
}

std::string to_json_line(const RealMesh& mesh) {
  Json runs = Json::array();
  for (const RealRun& run : mesh.runs) runs.push_back(as_json(run));
  return in_one_line({{"passed_over", mesh.passed_over}, {"runs", std::move(runs)}}) + "\n";
}

RealMesh parse_real_mesh(std::string_view json) {
  const JsonNode root = JsonNode::parse(json, "what was measured");
  return {root.at("passed_over").string(), runs_of(root.at("runs"))};
}

}  // namespace lapwing::bench
