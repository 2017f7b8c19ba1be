#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lapwing::bench {

/// Characters in a line of the reports for a terminal.
inline constexpr std::size_t kTerminalLine = 100;

/// Three digits that count, never an exponent, thousands apart: "0.0123", "12.3", "1,230".
std::string short_number(double value);

/// Of a share: "12%", "0.3%".
std::string percent(double share);

/// The nearest number of six digits that count: more than any clock is good for.
double six_digits(double value);

/// How many characters are seen, UTF-8 read as such.
std::size_t character_count(std::string_view text);

/// With spaces up to `width` characters; unchanged where it is longer.
std::string padded_right(std::string text, std::size_t width);
std::string padded_left(const std::string& text, std::size_t width);

/// Not wider than `width` characters: what is too long ends in "...".
std::string clipped(std::string_view text, std::size_t width);

}  // namespace lapwing::bench
