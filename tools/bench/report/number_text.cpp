#include "report/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "lapwing/base/grouped.h"

namespace lapwing::bench {
namespace {

std::string fixed(double value, int decimals) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

// Prints `digits` significant digits, counted after rounding, which may add one: 9.999 is "10.0".
std::string with_digits(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return fixed(value, 0);
  constexpr int kMostDecimals = 6;  // of a millisecond; no clock here resolves less
  const auto decimals_of = [&](double v) {
    const int before_point = static_cast<int>(std::floor(std::log10(std::abs(v)))) + 1;
    return std::clamp(digits - before_point, 0, kMostDecimals);
  };
  const int decimals = decimals_of(value);
  const double unit = std::pow(10.0, decimals);
  const double printed = std::round(value * unit) / unit;
  return fixed(value, printed == 0.0 ? decimals : std::min(decimals, decimals_of(printed)));
}

}  // namespace

std::string short_number(double value) {
  constexpr double kGrouped = 1000.0;
  if (value >= kGrouped - 0.5 && value < 1e18) {
    return grouped(static_cast<std::uint64_t>(std::llround(value)));
  }
  return with_digits(value, 3);
}

std::string percent(double share) {
  const double value = 100.0 * share;
  return fixed(value, std::abs(value) < 9.95 && value != 0.0 ? 1 : 0) + "%";
}

double six_digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

std::size_t character_count(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

std::string padded_right(std::string text, std::size_t width) {
  const std::size_t length = character_count(text);
  if (length < width) text.append(width - length, ' ');
  return text;
}

std::string padded_left(const std::string& text, std::size_t width) {
  const std::size_t length = character_count(text);
  return length < width ? std::string(width - length, ' ') + text : text;
}

std::string clipped(std::string_view text, std::size_t width) {
  if (character_count(text) <= width) return std::string(text);
  std::size_t end = 0;
  for (std::size_t characters = 0; end < text.size(); ++end) {
    const bool starts = (static_cast<unsigned char>(text[end]) >> 6) != 2;
    if (starts && ++characters > width - 3) break;
  }
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace lapwing::bench
