#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace lapwing {

/// Sets the value at `pointer` (RFC 6901) in `document`. It replaces a value, adds a key to an
/// existing object, or, with "-", appends to an existing list. Throws InputError for any other
/// pointer. The message begins with `where` and names the longest valid prefix of the pointer.
void set_json(nlohmann::ordered_json& document, const std::string& pointer,
              nlohmann::ordered_json value, const std::string& where);

}  // namespace lapwing
