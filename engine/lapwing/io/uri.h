#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace lapwing {

/// Returns the relative path of a URI: "my%20mesh.bin" becomes "my mesh.bin".
std::string path_of_uri(std::string_view uri);
/// Returns the URI of a relative path.
std::string uri_of_path(std::string_view path);

/// Decodes base64 (RFC 4648), with or without padding. Returns nullopt if `text` is not base64.
std::optional<std::string> decode_base64(std::string_view text);

/// Encodes `bytes` with padding.
std::string encode_base64(std::string_view bytes);

}  // namespace lapwing
