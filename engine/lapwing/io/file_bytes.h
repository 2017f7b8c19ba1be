#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace lapwing {

/// Owns a POSIX file descriptor; closes it when it goes out of scope.
class FileDescriptor {
 public:
  explicit FileDescriptor(int descriptor) : descriptor_(descriptor) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  /// Closes the current descriptor and takes ownership of `descriptor`.
  void reset(int descriptor) {
    close();
    descriptor_ = descriptor;
  }
  /// Returns false and sets errno if the system reports a late write error.
  bool close() {
    const int descriptor = std::exchange(descriptor_, -1);
    return descriptor < 0 || ::close(descriptor) == 0;
  }

 private:
  int descriptor_;
};

/// A file's content in memory, followed by one NUL byte, so that a scanner may look at the byte
/// at the end. A copy, not a mapping: another program that shortens the file cannot crash us.
class FileBytes {
 public:
  /// Reads the whole file. Throws IoError with the system's reason.
  static FileBytes read(const std::filesystem::path& path);
  /// The same for a mesh, an image or a table. Throws InputError, naming the kind of the file, if
  /// it is a Git LFS pointer, a web page or a compressed file, whatever its name says.
  static FileBytes read_data(const std::filesystem::path& path);

  std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

}  // namespace lapwing
