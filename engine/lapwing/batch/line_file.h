#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "lapwing/io/file_descriptor.h"

namespace lapwing {

/// A file of lines that grows while others read it, and outlives whoever writes it: what is killed
/// in a line leaves a line without its end, which does not count.
class LineFile {
 public:
  /// Opens `path`, made if it is not there, to append to. A last line without end is cut off.
  /// Throws IoError where the system refuses, or another process has the file open so.
  explicit LineFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }

  /// Appends `line` and its end in one go. Throws IoError with the system's reason; part of the
  /// line may then be there.
  void append(std::string line);

 private:
  std::filesystem::path path_;
  FileDescriptor file_;
};

/// Calls `take` with each whole line of `path`; nothing for a file that is not there. Throws
/// IoError.
void for_each_line(const std::filesystem::path& path,
                   const std::function<void(std::string_view line)>& take);

}  // namespace lapwing
