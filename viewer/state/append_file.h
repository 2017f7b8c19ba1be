#pragma once

#include <filesystem>
#include <string_view>

#include "lapwing/io/file_descriptor.h"

namespace lapwing::viewer {

/// Appends `bytes` and flushes them to the disk. On failure returns false, with errno set, and
/// restores the file's length; closes the file if that fails, too.
bool append(FileDescriptor& file, std::string_view bytes);

/// Flushes the names of the files in `folder` to the disk. Without that a power cut may lose a new
/// file.
void flush_folder(const std::filesystem::path& folder);

}  // namespace lapwing::viewer
