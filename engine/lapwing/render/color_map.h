#pragma once

#include <Eigen/Core>

namespace lapwing {

/// How a number becomes a colour. Both maps are made in the perceptually uniform space OKLab
/// (B. Ottosson, 2020), so that equal steps of the number look equally large.
enum class ColorMap {
  sequential,  ///< dark violet over teal to light yellow; lightness rises evenly
  diverging,   ///< blue over light grey to red; lightness is symmetric
};

/// Linear sRGB of `t`, which is clamped to [0, 1]. Every colour is displayable without clipping.
Eigen::Vector3f map_color(ColorMap map, float t);

}  // namespace lapwing
