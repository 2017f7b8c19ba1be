#include "report/report_json.h"

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "report/number_text.h"

namespace lapwing::bench {

namespace {

const char* const kFormat = "lapwing-bench 1";

std::string in_one_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json digits_of(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(six_digits(value));
  return list;
}

const char* key_of_bound(bool is_floor) {
  return is_floor ? "at_least" : "at_most";
}

}  // namespace

// nlohmann::json calls the following functions, which it finds by argument-dependent lookup.

void to_json(Json& json, const Host& host) {
  json = {{"processor", host.processor},
          {"threads", host.threads},
          {"memory_bytes", host.memory_bytes},
          {"system", host.system},
          {"compiler", host.compiler}};
}

void from_json(const Json& json, Host& host) {
  json.at("processor").get_to(host.processor);
  json.at("threads").get_to(host.threads);
  json.at("memory_bytes").get_to(host.memory_bytes);
  json.at("system").get_to(host.system);
  json.at("compiler").get_to(host.compiler);
}

void to_json(Json& json, const Limits& limits) {
  json = {{"device", limits.device},
          {"type", limits.type},
          {"driver", limits.driver},
          {"copy_gb_per_s", six_digits(limits.copy_gb_per_s)},
          {"matmul_gflops_float32", six_digits(limits.matmul_gflops_float32)},
          {"matmul_gflops_float64", six_digits(limits.matmul_gflops_float64)}};
}

void from_json(const Json& json, Limits& limits) {
  json.at("device").get_to(limits.device);
  json.at("type").get_to(limits.type);
  json.at("driver").get_to(limits.driver);
  json.at("copy_gb_per_s").get_to(limits.copy_gb_per_s);
  json.at("matmul_gflops_float32").get_to(limits.matmul_gflops_float32);
  json.at("matmul_gflops_float64").get_to(limits.matmul_gflops_float64);
}

void to_json(Json& json, const Measurement& m) {
  json = {{"stage", m.stage},
          {"by", m.by},
          {"device", m.device},
          {"mesh", m.mesh},
          {"vertices", m.vertices},
          {"wall_ms", digits_of(m.wall_ms)},
          {"cpu_ms", digits_of(m.cpu_ms)},
          {"device_ms", digits_of(m.device_ms)},
          {"peak_bytes", m.peak_bytes},
          {"counts", m.counts}};
}

void from_json(const Json& json, Measurement& m) {
  json.at("stage").get_to(m.stage);
  json.at("by").get_to(m.by);
  json.at("device").get_to(m.device);
  json.at("mesh").get_to(m.mesh);
  json.at("vertices").get_to(m.vertices);
  json.at("wall_ms").get_to(m.wall_ms);
  json.at("cpu_ms").get_to(m.cpu_ms);
  json.at("device_ms").get_to(m.device_ms);
  json.at("peak_bytes").get_to(m.peak_bytes);
  json.at("counts").get_to(m.counts);
}

void to_json(Json& json, const Target& target) {
  json = {{"name", target.name},
          {"on", target.on},
          {key_of_bound(target.is_floor), six_digits(target.at_most)},
          {"measured", six_digits(target.measured)}};
}

void from_json(const Json& json, Target& target) {
  json.at("name").get_to(target.name);
  json.at("on").get_to(target.on);
  target.is_floor = json.contains(key_of_bound(true));
  json.at(key_of_bound(target.is_floor)).get_to(target.at_most);
  json.at("measured").get_to(target.measured);
}

std::string json_by_lines(const Json& object) {
  std::string text = "{";
  for (const auto& [key, value] : object.items()) {
    text += (text.size() > 1 ? ",\n  " : "\n  ") + Json(key).dump() + ": ";
    if (!value.is_array() || value.empty()) {
      text += in_one_line(value);
      continue;
    }
    std::string separator = "[\n    ";
    for (const Json& element : value) {
      text += separator + in_one_line(element);
      separator = ",\n    ";
    }
    text += "\n  ]";
  }
  return text + "\n}\n";
}

void fail_to_read(const std::string& name, const std::string& why) {
  throw InputError(name + ": " + why + ". Pass a complete file of this version's --json.");
}

Json parse_format(std::string_view json, const std::string& format, const std::string& name) {
  return reading_json(name, [&] {
    Json root = Json::parse(json);
    const auto found = root.at("format").get<std::string>();
    if (found != format) {
      fail_to_read(name, "the format is \"" + found + "\", expected \"" + format + "\"");
    }
    return root;
  });
}

std::string to_json(const Report& report) {
  return json_by_lines({{"format", kFormat},
                        {"date", report.date},
                        {"commit", report.commit},
                        {"command", report.command},
                        {"host", report.host},
                        {"limits", report.limits},
                        {"measurements", report.measurements},
                        {"targets", report.targets}});
}

Report parse_report(std::string_view json, const std::string& name) {
  const Json root = parse_format(json, kFormat, name);
  return reading_json(name, [&] {
    Report report;
    root.at("date").get_to(report.date);
    root.at("commit").get_to(report.commit);
    root.at("command").get_to(report.command);
    root.at("host").get_to(report.host);
    root.at("limits").get_to(report.limits);
    root.at("measurements").get_to(report.measurements);
    root.at("targets").get_to(report.targets);
    return report;
  });
}

Report read_report(const std::filesystem::path& path) {
  return parse_report(FileBytes::read(path).view(), path.string());
}

}  // namespace lapwing::bench
