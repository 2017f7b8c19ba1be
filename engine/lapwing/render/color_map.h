#pragma once

#include <Eigen/Core>

namespace lapwing {

/// Maps from numbers to colours. Both are made in the perceptually uniform space OKLab (B.
/// Ottosson, 2020), so that equal steps of the number look equally large.
enum class ColorMap {
  sequential,  ///< dark violet over teal to light yellow; lightness rises evenly
  diverging,   ///< blue over light grey to red; lightness is symmetric
};

/// Returns the linear sRGB colour of `t`, clamped to [0, 1]. All colours can be shown without
/// clipping.
Eigen::Vector3f map_color(ColorMap map, float t);

}  // namespace lapwing
