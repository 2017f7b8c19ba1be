#pragma once

#include <Eigen/Core>

namespace lapwing {

/// Colour maps for scalar values. Both are defined in the perceptually uniform colour space OKLab
/// (B. Ottosson, 2020), so that equal differences of the value look equally large.
enum class ColorMap {
  sequential,  ///< dark violet, teal, light yellow; lightness increases linearly
  diverging,   ///< blue, light grey, red; lightness is symmetric
};

/// Returns the linear sRGB colour of `t`, which is clamped to [0, 1]. All colours are inside the
/// sRGB gamut.
Eigen::Vector3f map_color(ColorMap map, float t);

}  // namespace lapwing
