#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "lapwing/json/json_node.h"

namespace lapwing {

/// How deep lists and objects may lie in each other: three times what the deepest region of a
/// recipe takes, and little enough for what walks through a document by calling itself once a
/// level.
inline constexpr std::size_t kDeepestJson = 500;

/// The document that `text` is. Throws InputError with line and column when it is no JSON, when a
/// number is beyond double, when it is nested deeper than kDeepestJson, and when an object names a
/// key twice; `name` is what messages call it, and `first_line` its first line.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name,
                                  std::size_t first_line = 1);

/// A document that was not read from text. Its strings need not be UTF-8, as names of files are
/// not.
struct JsonNode::Document {
  nlohmann::ordered_json json;
};

/// Key `key` as a token of a JSON pointer (RFC 6901).
std::string pointer_token(std::string_view key);

}  // namespace lapwing
