#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/io/image.h"

namespace lapwing {

/// Images with their mip levels, each half as large as the one before, down to one pixel. The words
/// are those that `shaders/file_color.glsl` reads:
///
/// - 256: linear light of each byte in sRGB, as float bits
/// - 4 per image: columns, rows, number of levels, and the index of its first offset
/// - the offsets: for each level of each image, the index of its first pixel
/// - the pixels, by rows from the top: red, green and blue in sRGB from the lowest byte up
///
/// Opacity is dropped, so that the edited surface stays visible. Images without pixels must not be
/// looked up.
std::vector<std::uint32_t> mip_levels(std::span<const Image> images);

/// The colours of a file, ready for surfaces of every mesh with attributes from that file.
struct FilePaint {
  explicit FilePaint(FileColors read) : colors(std::move(read)), images(mip_levels(colors.images)) {
    colors.images = {};
  }

  FileColors colors;                  ///< without the images
  std::vector<std::uint32_t> images;  ///< result of mip_levels
};

}  // namespace lapwing
