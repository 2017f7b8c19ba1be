#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "lapwing/io/file_bytes.h"

namespace lapwing {

/// A file of lines to which one process appends while others read it. If the process is killed
/// while it writes a line, the line has no line end and is ignored.
class LineFile {
 public:
  /// Opens `path` for appending, and creates it if necessary. Removes a last line without line end.
  /// Throws IoError if the file cannot be opened, or if another LineFile has opened it.
  explicit LineFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// Appends `line` and a line end. Throws IoError with the system's error message; the file may
  /// then contain a part of the line.
  void append(std::string line);

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

/// Calls `take` for each complete line of `path`. Does nothing if the file does not exist. Throws
/// IoError.
void for_each_line(const std::filesystem::path& path,
                   const std::function<void(std::string_view line)>& take);

}  // namespace lapwing
