#pragma once

#include <cstddef>
#include <string>

namespace lapwing::bench {

/// Line width of reports for a terminal, in characters.
inline constexpr std::size_t kTerminalLine = 100;

/// Prints three significant digits, no exponent, and groups thousands: "0.0123", "12.3", "1,230".
std::string short_number(double value);

/// Prints a share as a percentage: "12%", "0.3%".
std::string percent(double share);

/// Rounds to six significant digits, more than any clock measures.
double six_digits(double value);

/// Pads with spaces to `width` characters. Returns longer text unchanged.
std::string padded_right(std::string text, std::size_t width);
std::string padded_left(const std::string& text, std::size_t width);

/// Shortens text of more than `width` characters, so that it ends in "...".
std::string clipped(const std::string& text, std::size_t width);

}  // namespace lapwing::bench
