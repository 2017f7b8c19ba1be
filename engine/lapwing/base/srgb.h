#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lapwing {

// Conversions of a colour component (red, green or blue) between linear light and sRGB (IEC
// 61966-2-1).

/// `encoded` must be in [0, 1].
inline float linear_of_srgb(float encoded) {
  return encoded <= 0.04045F ? encoded / 12.92F : std::pow((encoded + 0.055F) / 1.055F, 2.4F);
}
inline float linear_of_srgb(std::uint8_t encoded) {
  return linear_of_srgb(static_cast<float>(encoded) / 255.0F);
}

/// `linear` is clamped to [0, 1].
inline float srgb_of_linear(float linear) {
  const float c = std::clamp(linear, 0.0F, 1.0F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1.0F / 2.4F) - 0.055F;
}
/// Returns the nearest byte.
inline std::uint8_t srgb_byte_of(float linear) {
  return static_cast<std::uint8_t>(std::lround(255.0F * srgb_of_linear(linear)));
}

}  // namespace lapwing
