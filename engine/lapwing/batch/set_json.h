#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace lapwing {

/// Sets the value at `pointer` (RFC 6901) in `document`. It may replace a value, add a key to an
/// existing object, or with "-" append to an existing list. Throws InputError for any other
/// pointer. The message begins with `where` and names the nearest existing place.
void set_json(nlohmann::ordered_json& document, const std::string& pointer,
              nlohmann::ordered_json value, const std::string& where);

}  // namespace lapwing
