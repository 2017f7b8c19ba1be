#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace lapwing {

/// Throws IoError unless a file can be put at `path`: its folder is there and takes files, and what
/// is at `path`, if anything, is a regular file that may be written. What takes long asks first.
void require_replaceable(const std::filesystem::path& path);

/// Puts `bytes` at `path` in one step: they are written to a temporary, flushed to the disk, and
/// renamed over it. Whoever opens `path` sees the old file or the new one, never a part. On failure
/// the old file stays as it was, nothing else is left, and IoError carries the system's reason. A
/// symbolic link keeps pointing where it did and its target is replaced; the permission bits of a
/// file that is replaced are kept.
///
/// The temporary has no name until it is whole, so that nothing of it is left where the process is
/// killed. Where the file system knows no such files it is NAME.tmp-0, or the next number that no
/// living process writes: those of dead ones are replaced. It is the user's alone until it is
/// whole.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

/// The same for a file that comes in parts, or that another program writes. Without `commit` the
/// temporary goes, and the old file stays. Throws what replace_file throws.
class FileReplacement {
 public:
  explicit FileReplacement(const std::filesystem::path& path);
  ~FileReplacement();
  FileReplacement(FileReplacement&&) noexcept;
  FileReplacement& operator=(FileReplacement&&) noexcept;

  const std::filesystem::path& path() const;  ///< as it was given
  /// Gives the temporary a name, beside the target, for another program to write into.
  const std::filesystem::path& temporary();
  void write(std::string_view bytes);  ///< after what was written before
  void flush();                        ///< to the disk
  void commit();                       ///< flushed or not

 private:
  class Temporary;
  std::unique_ptr<Temporary> temporary_;
};

/// Several files that belong together: each is whole on the disk before the first of them is put in
/// its place, so that a full disk or a folder that takes no files changes none of them.
class FileReplacements {
 public:
  /// Throws what replace_file throws; then nothing that was added is in place.
  void add(const std::filesystem::path& path, std::string_view bytes);
  /// In the order they were added. Throws IoError that says which are in place, if some are.
  void commit();

 private:
  std::vector<FileReplacement> files_;
};

}  // namespace lapwing
