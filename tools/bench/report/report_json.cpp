#include "report/report_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "lapwing/io/file_bytes.h"
#include "lapwing/json/json_node.h"
#include "report/number_text.h"

namespace lapwing::bench {
namespace {

using Json = nlohmann::ordered_json;

const char* const kFormat = "lapwing-bench 1";

Json list_of(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(six_digits(value));
  return list;
}

Json as_json(const Host& host) {
  return {{"processor", host.processor},
          {"threads", host.threads},
          {"memory_bytes", host.memory_bytes},
          {"system", host.system},
          {"compiler", host.compiler}};
}

Json as_json(const Limits& limits) {
  return {{"device", limits.device},
          {"type", limits.type},
          {"driver", limits.driver},
          {"copy_gb_per_s", six_digits(limits.copy_gb_per_s)},
          {"matmul_gflops_float32", six_digits(limits.matmul_gflops_float32)},
          {"matmul_gflops_float64", six_digits(limits.matmul_gflops_float64)}};
}

Json as_json(const Measurement& m) {
  Json counts = Json::object();
  for (const auto& [name, count] : m.counts) counts[name] = count;
  return {{"stage", m.stage},
          {"by", m.by},
          {"device", m.device},
          {"mesh", m.mesh},
          {"vertices", m.vertices},
          {"wall_ms", list_of(m.wall_ms)},
          {"cpu_ms", list_of(m.cpu_ms)},
          {"device_ms", list_of(m.device_ms)},
          {"peak_bytes", m.peak_bytes},
          {"counts", std::move(counts)}};
}

Json as_json(const Target& target) {
  return {{"name", target.name},
          {"on", target.on},
          {target.is_floor ? "at_least" : "at_most", six_digits(target.at_most)},
          {"measured", six_digits(target.measured)}};
}

template <class Item>
std::string lines(const std::vector<Item>& items) {
  std::string text = "[";
  for (const Item& item : items) {
    text += (text.size() > 1 ? ",\n    " : "\n    ") + as_json(item).dump();
  }
  return text + (items.empty() ? "]" : "\n  ]");
}

std::uint64_t whole_number(const JsonNode& node) {
  constexpr double kLargest = 9007199254740992.0;  // 2^53; not all larger whole numbers are doubles
  const double value = node.number_from_zero();
  if (value != std::floor(value) || value > kLargest) node.fail_expecting("a whole number, from 0");
  return static_cast<std::uint64_t>(value);
}

std::vector<double> times(const JsonNode& node) {
  std::vector<double> values;
  for (const JsonNode& element : node.elements()) values.push_back(element.number_from_zero());
  return values;
}

void require_format(const JsonNode& root) {
  const JsonNode format = root.at("format");
  if (format.string() == kFormat) return;
  format.fail("this is \"" + format.string() + "\", and what is read here is \"" + kFormat +
              "\"; measure again, or use the lapwing-bench that wrote it");
}

Host host_of(const JsonNode& node) {
  node.require_keys({"processor", "threads", "memory_bytes", "system", "compiler"});
  return {node.at("processor").string(), static_cast<unsigned>(whole_number(node.at("threads"))),
          whole_number(node.at("memory_bytes")), node.at("system").string(),
          node.at("compiler").string()};
}

Limits read_limits(const JsonNode& node) {
  node.require_keys({"device", "type", "driver", "copy_gb_per_s", "matmul_gflops_float32",
                     "matmul_gflops_float64"});
  return {node.at("device").string(),
          node.at("type").string(),
          node.at("driver").string(),
          node.at("copy_gb_per_s").number_from_zero(),
          node.at("matmul_gflops_float32").number_from_zero(),
          node.at("matmul_gflops_float64").number_from_zero()};
}

Measurement measurement_of(const JsonNode& node) {
  node.require_keys({"stage", "by", "device", "mesh", "vertices", "wall_ms", "cpu_ms", "device_ms",
                     "peak_bytes", "counts"});
  Measurement m;
  m.stage = node.at("stage").string();
  m.by = node.at("by").string();
  m.device = node.at("device").string();
  m.mesh = node.at("mesh").string();
  m.vertices = whole_number(node.at("vertices"));
  m.wall_ms = times(node.at("wall_ms"));
  m.cpu_ms = times(node.at("cpu_ms"));
  m.device_ms = times(node.at("device_ms"));
  m.peak_bytes = whole_number(node.at("peak_bytes"));
  const JsonNode counts = node.at("counts");
  for (const std::string& name : counts.keys()) m.counts[name] = whole_number(counts.at(name));
  return m;
}

Target target_of(const JsonNode& node) {
  node.require_keys({"name", "on", "at_most", "at_least", "measured"});
  const auto bound = node.only_key_of({"at_most", "at_least"}, "a target");
  return {node.at("name").string(), node.at("on").string(), node.at(bound).number(),
          bound == "at_least", node.at("measured").number()};
}

}  // namespace

std::string to_json(const Report& report) {
  std::string text = "{\n  \"format\": " + Json(kFormat).dump();
  const auto add = [&](const char* key, const std::string& value) {
    text += ",\n  " + Json(key).dump() + ": " + value;
  };
  add("date", Json(report.date).dump());
  add("commit", Json(report.commit).dump());
  add("command", Json(report.command).dump());
  add("host", as_json(report.host).dump());
  add("limits", lines(report.limits));
  add("measurements", lines(report.measurements));
  add("targets", lines(report.targets));
  return text + "\n}\n";
}

Report read_report(const std::filesystem::path& path) {
  return parse_report(FileBytes::read(path).view(), path.string());
}

Report parse_report(std::string_view json, const std::string& name) {
  const JsonNode root = JsonNode::parse(json, name);
  require_format(root);
  root.require_keys(
      {"format", "date", "commit", "command", "host", "limits", "measurements", "targets"});
  Report report;
  report.date = root.at("date").string();
  report.commit = root.at("commit").string();
  report.command = root.at("command").string();
  report.host = host_of(root.at("host"));
  for (const JsonNode& node : root.at("limits").elements()) {
    report.limits.push_back(read_limits(node));
  }
  for (const JsonNode& node : root.at("measurements").elements()) {
    report.measurements.push_back(measurement_of(node));
  }
  for (const JsonNode& node : root.at("targets").elements()) {
    report.targets.push_back(target_of(node));
  }
  return report;
}

}  // namespace lapwing::bench
