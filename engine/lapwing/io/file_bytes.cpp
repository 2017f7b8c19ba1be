#include "lapwing/io/file_bytes.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "lapwing/base/errors.h"

namespace lapwing {

namespace {

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error) {
  throw IoError("cannot read " + path.string() + ": " + std::strerror(error) +
                "; check the path and its permissions");
}

}  // namespace

FileBytes FileBytes::read(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe would wait for a writer.
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file.is_open()) fail_to_read(path, errno);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_to_read(path, errno);
  if (!S_ISREG(status.st_mode)) {
    throw IoError("cannot read " + path.string() + ": not a regular file; choose a file");
  }
  FileBytes bytes;
  const auto capacity = static_cast<std::size_t>(status.st_size);
  bytes.data_ = std::make_unique_for_overwrite<char[]>(capacity + 1);
  while (bytes.size_ < capacity) {
    const ssize_t got = ::read(file.get(), bytes.data_.get() + bytes.size_, capacity - bytes.size_);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail_to_read(path, errno);
    if (got == 0) break;
    bytes.size_ += static_cast<std::size_t>(got);
  }
  bytes.data_[bytes.size_] = '\0';
  return bytes;
}

}  // namespace lapwing
