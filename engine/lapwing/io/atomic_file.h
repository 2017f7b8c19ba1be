#pragma once

#include <filesystem>
#include <string_view>

namespace lapwing {

/// Puts `bytes` at `path` in one step: they are written to a temporary beside it, flushed to the
/// disk, and renamed over it. Whoever opens `path` sees the old file or the new one, never a part.
/// On failure the old file stays as it was, the temporary is removed, and IoError carries the
/// system's reason. A symbolic link keeps pointing where it did and its target is replaced; the
/// permission bits of a file that is replaced are kept.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace lapwing
