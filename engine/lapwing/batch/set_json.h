#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace lapwing {

/// Puts `value` at the JSON pointer `pointer` (RFC 6901) of `document`: in place of what is there,
/// as a new key of an object that is there, or with "-" at the end of a list that is there. Throws
/// InputError with the nearest place there is, `where` before it, for any other pointer.
void set_json(nlohmann::ordered_json& document, const std::string& pointer,
              nlohmann::ordered_json value, const std::string& where);

}  // namespace lapwing
