#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "lapwing/io/file_bytes.h"

namespace lapwing {

/// A file of lines that others can read while it grows. If the writer is killed within a line, that
/// line has no end and does not count.
class LineFile {
 public:
  /// Opens `path` for appending, and creates it if necessary. Cuts off a last line without end.
  /// Throws IoError if the system refuses, or if another LineFile has the file open.
  explicit LineFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// Appends `line` and its end. Throws IoError with the system's reason; part of the line may then
  /// be in the file.
  void append(std::string line);

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

/// Calls `take` with each complete line of `path`. Does nothing if the file does not exist. Throws
/// IoError.
void for_each_line(const std::filesystem::path& path,
                   const std::function<void(std::string_view line)>& take);

}  // namespace lapwing
