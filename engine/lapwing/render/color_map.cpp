#include "lapwing/render/color_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing {
namespace {

// Converts OKLab in polar form to linear sRGB. The hue is in degrees. Matrices: B. Ottosson, "A
// perceptual color space for image processing", 2020.
Eigen::Vector3f from_oklch(float lightness, float chroma, float hue) {
  const float angle = hue * std::numbers::pi_v<float> / 180.0F;
  const Eigen::Vector3f lab(lightness, chroma * std::cos(angle), chroma * std::sin(angle));
  const Eigen::Matrix3f to_cones{{1.0F, 0.3963377774F, 0.2158037573F},
                                 {1.0F, -0.1055613458F, -0.0638541728F},
                                 {1.0F, -0.0894841775F, -1.2914855480F}};
  const Eigen::Matrix3f to_rgb{{4.0767416621F, -3.3077115913F, 0.2309699292F},
                               {-1.2684380046F, 2.6097574011F, -0.3413193965F},
                               {-0.0041960863F, -0.7034186147F, 1.7076147010F}};
  return to_rgb * (to_cones * lab).array().cube().matrix();
}

// The hue changes linearly. The chroma follows the boundary of the sRGB gamut, which is narrowest
// at teal.
Eigen::Vector3f sequential(float t) {
  const float from_teal = t - 0.44F;
  return from_oklch(0.36F + 0.57F * t, 0.098F + 0.22F * from_teal * from_teal, 305.0F - 200.0F * t);
}

Eigen::Vector3f diverging(float t) {
  constexpr float kBlue = 258.0F;
  constexpr float kRed = 28.0F;
  const float strength = std::abs(2.0F * t - 1.0F);
  return from_oklch(0.93F - 0.43F * strength, 0.16F * strength, t < 0.5F ? kBlue : kRed);
}

}  // namespace

Eigen::Vector3f map_color(ColorMap map, float t) {
  const float clamped = std::clamp(t, 0.0F, 1.0F);
  return map == ColorMap::sequential ? sequential(clamped) : diverging(clamped);
}

}  // namespace lapwing
