#pragma once

#include <cstdint>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/render/mip_levels.h"

namespace lapwing {

/// The colours of a file, ready for surfaces of every mesh with attributes from that file.
struct FilePaint {
  explicit FilePaint(FileColors read) : colors(std::move(read)), images(mip_levels(colors.images)) {
    colors.images = {};
  }

  FileColors colors;                  ///< without the images
  std::vector<std::uint32_t> images;  ///< result of mip_levels
};

}  // namespace lapwing
