#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "lapwing/io/image.h"

namespace lapwing::test {

/// If $LAPWING_KEEP_PICTURES is set, saves the image as NAME.png in this folder.
inline void keep_picture(const Image& picture, const std::string& name) {
  const char* folder = std::getenv("LAPWING_KEEP_PICTURES");
  if (folder != nullptr) write_png(std::filesystem::path(folder) / (name + ".png"), picture);
}

}  // namespace lapwing::test
