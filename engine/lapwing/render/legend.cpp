#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "lapwing/render/overlay.h"

namespace lapwing {
namespace {

// Dark grey, legible on every background.
const Eigen::Vector3f kInk = Eigen::Vector3f::Constant(0.015F);

// Image height at which one dot of the font is one pixel. All lengths below are in dots.
constexpr float kHeightPerDot = 360.0F;
constexpr float kMargin = 12.0F;
constexpr float kBarWidth = 10.0F;
constexpr float kGap = 4.0F;
constexpr float kFrame = 1.0F;
constexpr float kCapitalHeight = 7.0F;
constexpr float kBarPart = 0.42F;  // fraction of the image height

float dot_size(std::uint32_t picture_height) {
  return std::max(1.0F, std::round(static_cast<float>(picture_height) / kHeightPerDot));
}

std::string label(float value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", static_cast<double>(value));
  return text.data();
}

}  // namespace

Overlay legend_overlay(const Legend& legend, std::uint32_t width, std::uint32_t height) {
  Overlay overlay;
  const auto picture_height = static_cast<float>(height);
  const float dot = dot_size(height);
  const float right = static_cast<float>(width) - kMargin * dot;
  const float left = right - kBarWidth * dot;
  const float bar_height = std::round(kBarPart * picture_height);
  const float top = std::round(0.5F * (picture_height - bar_height));
  const float bottom = top + bar_height;

  const float frame = kFrame * dot;
  overlay.add_rectangle(left - frame, top - frame, right + frame, bottom + frame, kInk);
  for (float y = top; y < bottom; ++y) {
    const float t = (bottom - y - 0.5F) / bar_height;
    overlay.add_rectangle(left, y, right, y + 1.0F, map_color(legend.color_map, t));
  }

  const auto write_left_of_bar = [&](float y, float value, const std::string& sign = {}) {
    const std::string text = sign + label(value);
    overlay.add_text(left - kGap * dot - Overlay::text_width(dot, text),
                     std::round(y - 0.5F * kCapitalHeight * dot), dot, kInk, text);
  };
  const ScalarRange& range = legend.range;
  write_left_of_bar(top, range.high, legend.more_above ? ">= " : "");
  write_left_of_bar(0.5F * (top + bottom), 0.5F * (range.low + range.high));
  write_left_of_bar(bottom, range.low, legend.less_below ? "<= " : "");
  // Write the lines of the title from bottom to top; the last line is just above the bar.
  float y = top - (2.0F * kCapitalHeight + kGap) * dot;
  std::string_view title = legend.title;
  while (!title.empty()) {
    const std::size_t line_break = title.rfind('\n');
    const std::string_view line =
        line_break == std::string_view::npos ? title : title.substr(line_break + 1);
    overlay.add_text(std::max(0.0F, right - Overlay::text_width(dot, line)), y, dot, kInk, line);
    y -= (kCapitalHeight + kGap) * dot;
    title = title.substr(0, line_break == std::string_view::npos ? 0 : line_break);
  }
  return overlay;
}

double legend_share(std::uint32_t width, std::uint32_t height) {
  const float dot = dot_size(height);
  const float covered =
      Overlay::text_width(dot, std::string(kLegendLetters, 'm')) + (kMargin + kGap) * dot;
  return std::min(0.5, static_cast<double>(covered) / width);
}

}  // namespace lapwing
