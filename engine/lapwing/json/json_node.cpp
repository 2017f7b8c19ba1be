#include "lapwing/json/json_node.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/json/suggest.h"

namespace lapwing {

struct JsonNode::Value {
  std::shared_ptr<const nlohmann::ordered_json> document;
  const nlohmann::ordered_json* json;
};

namespace {

using Json = nlohmann::ordered_json;

// Returns a description of a value for "got ..." in messages.
std::string in_words(const Json& json) {
  switch (json.type()) {
    case Json::value_t::null:
      return "null";
    case Json::value_t::object:
      return "an object";
    case Json::value_t::array:
      return "a list of " + std::to_string(json.size());
    case Json::value_t::string: {
      constexpr std::size_t kShown = 40;
      const auto& text = json.get_ref<const std::string&>();
      return text.size() <= kShown ? "the text \"" + text + "\"" : "a long text";
    }
    default:
      return json.dump();
  }
}

bool is_vertex(const Json& json) {
  if (!json.is_number_integer()) return false;
  // In documents that were not read from text, whole numbers may have a signed or unsigned type.
  const bool negative = !json.is_number_unsigned() && json.get<std::int64_t>() < 0;
  return !negative && json.get<std::uint64_t>() < kNoIndex;
}

}  // namespace

JsonNode::JsonNode(std::shared_ptr<const Value> value, std::string where)
    : value_(std::move(value)), where_(std::move(where)) {}

JsonNode JsonNode::parse(std::string_view text, const std::string& name) {
  return of(Document{parse_json(text, name)}, name);
}

JsonNode JsonNode::of(Document content, const std::string& name) {
  auto document = std::make_shared<const Json>(std::move(content.json));
  const Json* root = document.get();
  return {std::make_shared<const Value>(Value{std::move(document), root}), name};
}

JsonNode JsonNode::child(const void* json, const std::string& token) const {
  return {std::make_shared<const Value>(Value{value_->document, static_cast<const Json*>(json)}),
          where(token)};
}

std::string JsonNode::where(std::string_view pointer) const {
  const bool is_root = value_->json == value_->document.get();
  return where_ + (is_root ? ": /" : "/") + std::string(pointer);
}

void JsonNode::fail(const std::string& message) const {
  throw InputError(where_ + ": " + message);
}

void JsonNode::fail_expecting(const std::string& what) const {
  fail("expected " + what + ", got " + in_words(*value_->json));
}

void JsonNode::require_object() const {
  if (!value_->json->is_object()) fail_expecting("an object");
}

void JsonNode::require_list(const std::string& what) const {
  if (!value_->json->is_array()) fail_expecting(what);
}

void JsonNode::require_keys(const std::vector<std::string_view>& known) const {
  require_object();
  for (const auto& [key, value] : value_->json->items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      child(&value, pointer_token(key)).fail("unknown key; " + suggest(key, known));
    }
  }
}

std::vector<std::string> JsonNode::keys() const {
  require_object();
  std::vector<std::string> keys;
  for (const auto& [key, value] : value_->json->items()) keys.push_back(key);
  return keys;
}

bool JsonNode::has(std::string_view key) const {
  require_object();
  return value_->json->contains(key);
}

JsonNode JsonNode::at(std::string_view key) const {
  if (auto found = find(key)) return *std::move(found);
  fail("the key \"" + std::string(key) + "\" is missing; add it");
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  require_object();
  const auto found = value_->json->find(key);
  if (found == value_->json->end()) return std::nullopt;
  return child(&*found, pointer_token(key));
}

std::string_view JsonNode::only_key_of(const std::vector<std::string_view>& keys,
                                       const std::string& what) const {
  std::vector<std::string_view> present;
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(present),
               [&](std::string_view key) { return has(key); });
  if (present.size() == 1) return present.front();
  if (present.empty()) fail(what + " needs one of " + quoted_list(keys));
  fail(what + " takes only one of " + quoted_list(keys) + ", got " + quoted_list(present));
}

std::size_t JsonNode::one_of(const std::string& what,
                             const std::vector<std::string_view>& names) const {
  const std::string name = string();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) fail("unknown " + what + " \"" + name + "\"; " + suggest(name, names));
  return static_cast<std::size_t>(found - names.begin());
}

std::vector<JsonNode> JsonNode::elements() const {
  require_list("a list");
  std::vector<JsonNode> nodes;
  for (std::size_t k = 0; k < value_->json->size(); ++k) {
    nodes.push_back(child(&(*value_->json)[k], std::to_string(k)));
  }
  return nodes;
}

std::optional<JsonNode> JsonNode::element(std::size_t k) const {
  require_list("a list");
  if (k >= value_->json->size()) return std::nullopt;
  return child(&(*value_->json)[k], std::to_string(k));
}

JsonNode JsonNode::at(std::size_t k) const {
  if (auto found = element(k)) return *std::move(found);
  fail("element " + std::to_string(k) + " is missing; the list has " +
       std::to_string(value_->json->size()));
}

bool JsonNode::is_object() const {
  return value_->json->is_object();
}

bool JsonNode::is_string() const {
  return value_->json->is_string();
}

bool JsonNode::boolean() const {
  if (!value_->json->is_boolean()) fail_expecting("true or false");
  return value_->json->get<bool>();
}

std::string JsonNode::string() const {
  if (!value_->json->is_string()) fail_expecting("a text in quotes");
  return value_->json->get<std::string>();
}

std::string JsonNode::file_name() const {
  std::string text = string();
  if (text.empty()) fail("expected the name of a file, got an empty text");
  return text;
}

double JsonNode::number() const {
  if (!value_->json->is_number()) fail_expecting("a number");
  return value_->json->get<double>();
}

std::optional<double> JsonNode::if_number() const {
  if (!value_->json->is_number()) return std::nullopt;
  return value_->json->get<double>();
}

double JsonNode::positive_number() const {
  const Json& json = *value_->json;
  if (!json.is_number() || !(json.get<double>() > 0.0)) fail_expecting("a number above 0");
  return json.get<double>();
}

double JsonNode::number_from_zero() const {
  const Json& json = *value_->json;
  if (!json.is_number() || !(json.get<double>() >= 0.0)) fail_expecting("0 or more");
  return json.get<double>();
}

std::size_t JsonNode::count() const {
  const Json& json = *value_->json;
  // Accept 12.0, which some exporters write.
  constexpr double kMost = 9007199254740992.0;  // 2^53: doubles represent all smaller whole numbers
  const double value = json.is_number() ? json.get<double>() : -1.0;
  if (!(value >= 0.0 && value <= kMost && std::floor(value) == value)) {
    fail_expecting("a whole number from 0");
  }
  return static_cast<std::size_t>(value);
}

Index JsonNode::vertex() const {
  if (!is_vertex(*value_->json)) fail_expecting("a vertex number (whole, from 0)");
  return value_->json->get<Index>();
}

std::vector<Index> JsonNode::vertices() const {
  require_list("a list of vertex numbers");
  std::vector<Index> indices;
  indices.reserve(value_->json->size());
  // Lists may have a million elements, so a JsonNode is only created for an element with an error.
  for (const Json& element : *value_->json) {
    indices.push_back(is_vertex(element)
                          ? element.get<Index>()
                          : child(&element, std::to_string(indices.size())).vertex());
  }
  return indices;
}

std::vector<double> JsonNode::numbers() const {
  require_list("a list of numbers");
  std::vector<double> values;
  for (const JsonNode& element : elements()) values.push_back(element.number());
  return values;
}

Eigen::Vector3d JsonNode::vector3() const {
  require_list("3 numbers");
  const std::vector<double> values = numbers();
  if (values.size() != 3) fail("expected 3 numbers, got " + std::to_string(values.size()));
  return {values[0], values[1], values[2]};
}

}  // namespace lapwing
