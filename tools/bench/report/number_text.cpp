#include "report/number_text.h"

#include <cmath>
#include <cstdint>
#include <cstdio>

#include "lapwing/base/printable_text.h"

namespace lapwing::bench {
namespace {

std::string printed(const char* format, double value) {
  char text[400];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

}  // namespace

std::string short_number(double value) {
  constexpr double kGrouped = 999.5;
  constexpr double kMostGrouped = 1e18;
  constexpr double kClockResolution_ms = 1e-4;
  if (value == 0.0) return "0";
  if (value >= kGrouped && value < kMostGrouped) {
    return grouped(static_cast<std::uint64_t>(std::llround(value)));
  }
  if (std::abs(value) < kClockResolution_ms) return printed("%.6f", value);
  std::string text = printed(std::abs(value) < kGrouped ? "%#.3g" : "%.0f", value);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string percent(double share) {
  const double value = 100.0 * share;
  return printed(std::abs(value) < 9.95 && value != 0.0 ? "%.1f%%" : "%.0f%%", value);
}

double six_digits(double value) {
  return std::stod(printed("%.6g", value));
}

std::string padded_right(std::string text, std::size_t width) {
  if (text.size() < width) text.resize(width, ' ');
  return text;
}

std::string padded_left(const std::string& text, std::size_t width) {
  return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

std::string clipped(const std::string& text, std::size_t width) {
  return text.size() <= width ? text : text.substr(0, width - 3) + "...";
}

}  // namespace lapwing::bench
