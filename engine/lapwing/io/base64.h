#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lapwing {

/// Decodes base64 (RFC 4648), with or without padding. Returns nullopt if `text` is not base64.
std::optional<std::string> decode_base64(std::string_view text);

/// Encodes `bytes` with padding.
std::string encode_base64(std::string_view bytes);

}  // namespace lapwing
