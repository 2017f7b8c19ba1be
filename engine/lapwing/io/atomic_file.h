#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace lapwing {

/// Puts `bytes` at `path` in one step: they are written to a temporary beside it, flushed to the
/// disk, and renamed over it. Whoever opens `path` sees the old file or the new one, never a part.
/// On failure the old file stays as it was, the temporary is removed, and IoError carries the
/// system's reason. A symbolic link keeps pointing where it did and its target is replaced; the
/// permission bits of a file that is replaced are kept.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

/// The same for a file that comes in parts, or that another program writes into `temporary()`,
/// which is there, empty, from the start. Once that is whole, `commit` puts it at `path`; without
/// that it goes, and the old file stays. Throws what replace_file throws.
class FileReplacement {
 public:
  explicit FileReplacement(const std::filesystem::path& path);
  ~FileReplacement();
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;

  const std::filesystem::path& temporary() const;
  void write(std::string_view bytes);  ///< after what was written before
  void commit();

 private:
  class Temporary;
  std::unique_ptr<Temporary> temporary_;
};

}  // namespace lapwing
