#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "lapwing/io/image.h"

namespace lapwing::test {

/// Saves `picture` as NAME.png in the folder $LAPWING_KEEP_PICTURES, if that is set.
inline void keep_picture(const Image& picture, const std::string& name) {
  const char* folder = std::getenv("LAPWING_KEEP_PICTURES");
  if (folder != nullptr) write_png(std::filesystem::path(folder) / (name + ".png"), picture);
}

}  // namespace lapwing::test
