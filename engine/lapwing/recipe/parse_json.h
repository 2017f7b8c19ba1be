#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace lapwing {

/// The document that `text` is. Throws InputError with line and column when it is no JSON, and when
/// an object names a key twice; `name` is what messages call it, and `first_line` its first line.
nlohmann::ordered_json parse_json(std::string_view text, const std::string& name,
                                  std::size_t first_line = 1);

/// Key `key` as a token of a JSON pointer (RFC 6901).
std::string pointer_token(std::string_view key);

}  // namespace lapwing
