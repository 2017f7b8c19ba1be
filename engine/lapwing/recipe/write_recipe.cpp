#include <array>
#include <charconv>

#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/key_writer.h"

namespace lapwing {
namespace {

constexpr std::size_t kLineWidth = 96;

std::string atom(const Json& json) {
  if (!json.is_number_float()) return json.dump();
  // Uses the shortest digits that read back to the same bits, and writes 10 instead of the
  // library's 10.0.
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), json.get<double>());
  return {digits.data(), end.ptr};
}

// Returns `json` on one line.
std::string flat(const Json& json) {
  if (!json.is_structured()) return atom(json);
  std::string text;
  for (const auto& [key, value] : json.items()) {
    if (!text.empty()) text += ", ";
    if (json.is_object()) text += Json(key).dump() + ": ";
    text += flat(value);
  }
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

// Fills lines with numbers up to the line width.
std::string filled(const Json& list, const std::string& indent) {
  std::string text = "[";
  std::size_t column = kLineWidth;
  for (const Json& value : list) {
    const std::string number = atom(value);
    if (text.size() > 1) text += ",";
    if (column + number.size() + 2 > kLineWidth) {
      text += "\n" + indent + "  ";
      column = indent.size() + 2;
    } else {
      text += " ";
      ++column;
    }
    text += number;
    column += number.size() + 1;
  }
  return text + "\n" + indent + "]";
}

// Returns `json` on one line if it fits after `column`, and otherwise one child per line.
std::string pretty(const Json& json, const std::string& indent, std::size_t column) {
  const std::string line = flat(json);
  if (column + line.size() < kLineWidth || !json.is_structured()) return line;
  if (json.is_array() && json.front().is_number()) return filled(json, indent);
  const std::string inner = indent + "  ";
  std::string text;
  for (const auto& [key, value] : json.items()) {
    const std::string label = json.is_object() ? Json(key).dump() + ": " : "";
    text += (text.empty() ? "\n" : ",\n") + inner + label;
    text += pretty(value, inner, inner.size() + label.size());
  }
  text += "\n" + indent;
  return json.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string to_json(const Recipe& recipe) {
  Json steps = Json::array();
  for (const Step& step : recipe.steps) steps.push_back(json_of(step));
  Json root{
      {"lapwing", kRecipeVersion}, {"mesh", recipe.mesh.string()}, {"steps", std::move(steps)}};
  if (!recipe.save.empty()) root["save"] = recipe.save.string();
  if (!recipe.morph_target.empty()) root["save_as"] = {{"morph_target", recipe.morph_target}};
  try {
    // Starting at the end of a line makes the root always span several lines.
    return pretty(root, "", kLineWidth) + "\n";
  } catch (const Json::type_error&) {
    throw InputError(
        "the name of the mesh, of a source or of the result is not UTF-8, but a recipe must be; "
        "rename the file");
  }
}

}  // namespace lapwing
