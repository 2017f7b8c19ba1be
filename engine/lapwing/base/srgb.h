#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lapwing {

// Conversions of a colour component (red, green or blue) between linear light and sRGB (IEC
// 61966-2-1). They use double precision, because 32-bit floats would turn 1 into 0.99999994.

/// `encoded` must be in [0, 1].
inline float linear_of_srgb(float encoded) {
  const double c = encoded;
  return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
}
inline float linear_of_srgb(std::uint8_t encoded) {
  return linear_of_srgb(static_cast<float>(encoded) / 255.0F);
}

/// `linear` is clamped to [0, 1].
inline float srgb_of_linear(float linear) {
  const double c = std::clamp(linear, 0.0F, 1.0F);
  return static_cast<float>(c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055);
}
/// Returns the nearest byte.
inline std::uint8_t srgb_byte_of(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0F * srgb_of_linear(linear)));
}

}  // namespace lapwing
