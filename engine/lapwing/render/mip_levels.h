#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lapwing/io/image.h"

namespace lapwing {

/// Images with their mip levels, each half as large as the one before down to one pixel, in the
/// words that `shaders/file_color.glsl` looks them up in:
///
/// - 256: linear light of each byte in sRGB, as float bits
/// - 4 per image: columns, rows, number of levels, and where the places of these stand
/// - the places: for each level of each image the word of its first pixel
/// - the pixels, by rows from the top: red, green and blue in sRGB from the lowest byte up
///
/// Opacity is left out: what is edited is to be seen. Images without pixels must not be looked up.
std::vector<std::uint32_t> mip_levels(std::span<const Image> images);

}  // namespace lapwing
