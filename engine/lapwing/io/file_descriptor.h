#pragma once

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

}  // namespace lapwing
