#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

#include "lapwing/io/file_bytes.h"

namespace lapwing {

/// Throws IoError if no file can be written to `path`. The folder must exist and be writable, and
/// an existing file at `path` must be a writable regular file. Long operations call this first.
void require_replaceable(const std::filesystem::path& path);

/// Replaces the file at `path` by `bytes` in one step: writes a temporary file, flushes it to the
/// disk and renames it to `path`. Readers of `path` see either the old file or the complete new
/// one. On failure the old file stays, no temporary file remains, and IoError carries the system's
/// reason. If `path` is a symbolic link, its target is replaced. The new file keeps the permission
/// bits of the old one.
///
/// The temporary file has no name until it is complete, so a killed process leaves nothing behind.
/// If the file system has no unnamed files, it is called NAME.tmp-0, or the next number that no
/// living process uses; files of dead processes are replaced. Only the user can access an
/// incomplete file.
void replace_file(const std::filesystem::path& path, std::string_view bytes);

/// The same for a file that is written in parts, or by another program. Without `commit`, the
/// destructor deletes the temporary file and the old file stays. Throws what replace_file throws.
class FileReplacement {
 public:
  explicit FileReplacement(const std::filesystem::path& path);
  ~FileReplacement();
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;

  const std::filesystem::path& path() const { return named_; }  ///< as passed to the constructor
  /// Gives the temporary file a name beside the target, so that another program can write to it.
  const std::filesystem::path& temporary();
  void write(std::string_view bytes);  ///< appends
  void flush();                        ///< to the disk
  void commit();                       ///< flushes, then replaces the target

 private:
  struct Unopened {};
  FileReplacement(const std::filesystem::path& path, Unopened);
  std::string link_of_descriptor() const;
  bool open_without_name();
  void open_with_name();
  void name_it();
  template <class Take>
  void for_each_name(const Take& take);
  bool link_to(const std::filesystem::path& name);
  void make_private();

  std::filesystem::path named_;
  std::filesystem::path target_;
  std::optional<mode_t> old_permissions_;  // nullopt if there is no old file
  mode_t permissions_ = 0;
  FileDescriptor file_{-1};
  std::filesystem::path path_;  // path of the temporary file; empty while it has no name
};

/// Several files that belong together. All are complete on the disk before the first one is put in
/// place, so a full disk or an unwritable folder changes none of them.
class FileReplacements {
 public:
  /// Writes a temporary file. Throws what replace_file throws.
  void add(const std::filesystem::path& path, std::string_view bytes);
  /// Puts the files in place, in the order they were added. If one fails, throws IoError that lists
  /// the files already in place.
  void commit();

 private:
  std::vector<std::unique_ptr<FileReplacement>> files_;
};

}  // namespace lapwing
