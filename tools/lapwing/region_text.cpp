#include "region_text.h"

#include <charconv>
#include <vector>

#include <CLI/CLI.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/recipe/read_values.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void fail(const std::string& flag, const std::string& text,
                       const char* expected = kRegionHelp) {
  throw CLI::ValidationError(flag, "cannot read \"" + text + "\"; expected " + expected);
}

// Parses numbers separated by commas. Unless `count` is 0, there must be exactly `count` numbers.
std::vector<Json> numbers(const std::string& flag, const std::string& text, const std::string& list,
                          std::size_t count, const char* expected = kRegionHelp) {
  std::vector<Json> values;
  const char* at = list.data();
  const char* end = at + list.size();
  for (;;) {
    double value = 0.0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc()) fail(flag, text, expected);
    // Write whole numbers as integers, because vertex numbers in a recipe must be integers.
    const auto whole = static_cast<long long>(value);
    values.push_back(static_cast<double>(whole) == value ? Json(whole) : Json(value));
    if (next == end) break;
    if (*next != ',') fail(flag, text, expected);
    at = next + 1;
  }
  if (count != 0 && values.size() != count) fail(flag, text, expected);
  return values;
}

}  // namespace

Json region_json(const std::string& flag, const std::string& text) {
  if (text == "all") return {{"all", true}};
  if (text.starts_with('{')) {
    Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) fail(flag, text);
    return json;
  }
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) return {{"vertices", numbers(flag, text, text, 0)}};
  const std::string form = text.substr(0, colon);
  const std::string list = text.substr(colon + 1);
  if (form == "disk") {
    const auto v = numbers(flag, text, list, 2);
    return {{"disk", {{"center", v[0]}, {"radius", v[1]}}}};
  }
  if (form == "near") {
    const auto v = numbers(flag, text, list, 4);
    return {{"disk", {{"near", Json::array({v[0], v[1], v[2]})}, {"radius", v[3]}}}};
  }
  if (form == "box") {
    const auto v = numbers(flag, text, list, 6);
    return {{"box",
             {{"min", Json::array({v[0], v[1], v[2]})}, {"max", Json::array({v[3], v[4], v[5]})}}}};
  }
  if (form == "fraction") return {{"fraction", numbers(flag, text, list, 1)[0]}};
  fail(flag, text);
}

RegionSpec region_spec(const std::string& flag, const std::string& text) {
  return read_region(JsonNode::of(JsonNode::Document{region_json(flag, text)}, flag));
}

Json mirror_json(const std::string& flag, const std::string& text) {
  if (text == "auto") return text;
  if (text == "x" || text == "y" || text == "z") return {{"plane", text}};
  const auto v = numbers(flag, text, text, 6, kMirrorHelp);
  return {{"point", Json::array({v[0], v[1], v[2]})}, {"normal", Json::array({v[3], v[4], v[5]})}};
}

MirrorSpec mirror_spec(const std::string& flag, const std::string& text) {
  return read_mirror(JsonNode::of(JsonNode::Document{mirror_json(flag, text)}, flag));
}

std::vector<double> vertex_property(const std::string& flag, const std::string& mesh,
                                    const std::string& name) {
  for (const ExtraAttribute& extra : read_mesh(mesh).attributes().vertex_extras) {
    if (extra.name == name && extra.components == 1) return extra.values;
  }
  throw InputError(flag + ": " + mesh + " has no scalar vertex property \"" + name +
                   "\"; use a PLY file that has one");
}

}  // namespace lapwing::cli
