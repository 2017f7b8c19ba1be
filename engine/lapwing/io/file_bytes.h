#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>

namespace lapwing {

/// A file's content in memory, followed by one NUL byte, so that a scanner may look at the byte
/// at the end. A copy, not a mapping: another program that shortens the file cannot crash us.
class FileBytes {
 public:
  /// Reads the whole file. Throws IoError with the system's reason.
  static FileBytes read(const std::filesystem::path& path);

  std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

}  // namespace lapwing
