#pragma once

#include <cstdint>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/render/mip_levels.h"

namespace lapwing {

/// The colours of a file, ready to be put on surfaces: for every mesh with attributes from there.
struct FilePaint {
  explicit FilePaint(FileColors read) : colors(std::move(read)), images(mip_levels(colors.images)) {
    colors.images = {};
  }

  FileColors colors;                  ///< without the images, which are in
  std::vector<std::uint32_t> images;  ///< mip_levels
};

}  // namespace lapwing
