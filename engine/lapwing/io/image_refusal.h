#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lapwing/base/errors.h"

namespace lapwing {

/// Throws the InputError for an image that cannot be read.
[[noreturn]] inline void refuse_image(const std::filesystem::path& path, std::string_view reason) {
  throw InputError(path.string() + ": not a PNG, JPEG, BMP or TGA image that can be read (" +
                   std::string(reason) + "); convert it to PNG");
}

}  // namespace lapwing
