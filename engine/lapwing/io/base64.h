#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lapwing {

/// The bytes that `text` stands for (RFC 4648, with or without padding); nothing where it is none.
std::optional<std::string> decode_base64(std::string_view text);

/// With padding.
std::string encode_base64(std::string_view bytes);

}  // namespace lapwing
