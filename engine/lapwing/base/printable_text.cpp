#include "lapwing/base/printable_text.h"

#include <array>
#include <cstdint>
#include <cstdio>

namespace lapwing {
namespace {

constexpr std::string_view kLeftOut = " ... ";

struct Character {
  std::size_t bytes = 1;
  std::uint32_t code = 0;
  bool valid = false;
};

// Decodes one character by RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF.
Character decode(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {1, first, true};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {};
  std::uint32_t code = first & (0xFFU >> (bytes + 1));
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(k) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(k) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[bytes] || surrogate || code > 0x10FFFF) return {};
  return {bytes, code, true};
}

bool is_plain(std::uint32_t code) {
  const auto within = [&](std::uint32_t first, std::uint32_t last) {
    return code >= first && code <= last;
  };
  return !(code < 0x20 || within(0x7F, 0x9F) ||  // controls of ASCII and Latin-1
           code == 0x061C || within(0x200E, 0x200F) || within(0x202A, 0x202E) ||
           within(0x2066, 0x2069) ||                   // direction marks
           within(0x2028, 0x2029) || code == 0xFEFF);  // line separators, byte order mark
}

void append_escape(std::string& out, char kind, int digits, unsigned value) {
  std::array<char, 16> escape{};
  std::snprintf(escape.data(), escape.size(), "\\%c%0*X", kind, digits, value);
  out += escape.data();
}

// Returns whether a character starts at byte `at`.
bool is_boundary(std::string_view text, std::size_t at) {
  return (static_cast<unsigned char>(text[at]) & 0xC0U) != 0x80U;
}

std::string shortened(const std::string& text, std::size_t longest) {
  const std::size_t kept = longest - kLeftOut.size();
  std::size_t head = kept / 2;
  while (head > 0 && !is_boundary(text, head)) --head;
  std::size_t tail = text.size() - (kept - kept / 2);
  while (tail < text.size() && !is_boundary(text, tail)) ++tail;
  return text.substr(0, head) + std::string(kLeftOut) + text.substr(tail);
}

}  // namespace

std::string printable(std::string_view text, std::size_t longest) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = decode(text);
    if (!c.valid) {
      append_escape(out, 'x', 2, static_cast<unsigned char>(text[0]));
    } else if (is_plain(c.code)) {
      out += text.substr(0, c.bytes);
    } else if (c.code < 0x100) {
      append_escape(out, 'x', 2, c.code);
    } else {
      append_escape(out, 'u', 4, c.code);
    }
    text.remove_prefix(c.bytes);
  }
  return out.size() <= longest ? out : shortened(out, longest);
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const Character c = decode(text);
    if (!c.valid) return false;
    text.remove_prefix(c.bytes);
  }
  return true;
}

std::string quoted_list(std::span<const std::string> names) {
  constexpr std::size_t kMostNames = 5;
  const std::size_t shown = names.size() > kMostNames ? kMostNames - 1 : names.size();
  std::string list;
  for (std::size_t k = 0; k < shown; ++k) {
    if (k > 0) list += k + 1 == names.size() ? " and " : ", ";
    list += "'" + names[k] + "'";
  }
  if (shown < names.size()) list += " and " + grouped(names.size() - shown) + " more";
  return list;
}

}  // namespace lapwing
