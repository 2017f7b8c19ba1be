#include "lapwing/io/uri.h"

#include <charconv>

namespace lapwing {

std::string path_of_uri(std::string_view uri) {
  std::string path;
  for (std::size_t k = 0; k < uri.size(); ++k) {
    unsigned byte = 0;
    const char* const digits = uri.data() + k + 1;
    if (uri[k] == '%' && k + 2 < uri.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      path += static_cast<char>(byte);
      k += 2;
    } else {
      path += uri[k];
    }
  }
  return path;
}

std::string uri_of_path(std::string_view path) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string uri;
  for (const char c : path) {
    if (kPlain.find(c) != std::string_view::npos) {
      uri += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    uri += {'%', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
  }
  return uri;
}

}  // namespace lapwing
