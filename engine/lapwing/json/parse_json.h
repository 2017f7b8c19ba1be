#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lapwing/json/json_node.h"

namespace lapwing {

/// Largest depth of nested lists and objects. It is three times the depth of the deepest valid
/// region of a recipe, and small enough for recursive functions.
inline constexpr std::size_t kDeepestJson = 500;

/// Parses `text`. Throws InputError with line and column if it is not JSON, if a number is too
/// large for a double, if values are nested deeper than kDeepestJson, or if an object has a key
/// twice. `name` is the name of the text in messages, and `first_line` the number of its first
/// line.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name,
                                  std::size_t first_line = 1);

/// A document that was not read from text. Its strings, such as file names, need not be UTF-8.
struct JsonNode::Document {
  nlohmann::ordered_json json;
};

/// Returns `key` as a token of a JSON pointer (RFC 6901).
std::string pointer_token(std::string_view key);

}  // namespace lapwing
