#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/io/image.h"

namespace lapwing {

/// Returns images with their mip levels, each half as large as the one before, down to one pixel.
/// The result consists of 32-bit words for `shaders/file_color.glsl`:
///
/// - 256 words: the linear value of each sRGB byte, as float bits
/// - 4 words per image: width, height, number of levels, index of the image's first offset
/// - the offsets: the index of the first pixel of each level of each image
/// - the pixels, by rows from the top: sRGB red, green and blue, from the lowest byte up
///
/// Opacity is ignored, so that the edited surface stays visible. Shaders must not sample images
/// without pixels.
std::vector<std::uint32_t> mip_levels(std::span<const Image> images);

/// The colours of a file, prepared for drawing any mesh whose attributes come from that file.
struct FilePaint {
  explicit FilePaint(FileColors read) : colors(std::move(read)), images(mip_levels(colors.images)) {
    colors.images = {};
  }

  FileColors colors;                  ///< without the images
  std::vector<std::uint32_t> images;  ///< result of mip_levels
};

}  // namespace lapwing
