#pragma once

#include <filesystem>
#include <string_view>

#include "lapwing/io/file_descriptor.h"

namespace lapwing::viewer {

/// Appends `bytes`, which are on the disk on return. False, with errno set, when they are not: then
/// the file is as it was, or, where what was written of them cannot be taken back, closed.
bool append(FileDescriptor& file, std::string_view bytes);

/// Has the names of the files in `folder` on the disk: a file is found after a power cut only then.
void flush_folder(const std::filesystem::path& folder);

}  // namespace lapwing::viewer
