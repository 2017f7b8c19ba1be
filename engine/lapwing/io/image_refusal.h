#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "lapwing/base/errors.h"

namespace lapwing {

/// Throws the InputError for an image that cannot be read.
[[noreturn]] inline void throw_image_error(const std::filesystem::path& path,
                                           std::string_view reason) {
  throw InputError(path.string() + ": cannot read the file as PNG, JPEG, BMP or TGA (" +
                   std::string(reason) + "); convert it to PNG");
}

}  // namespace lapwing
