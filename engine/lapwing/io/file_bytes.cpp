#include "lapwing/io/file_bytes.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/text_scanner.h"

namespace lapwing {

namespace {

[[noreturn]] void fail_to_read(const std::filesystem::path& path, int error) {
  throw IoError("cannot read " + path.string() + ": " + std::strerror(error) +
                "; check the path and its permissions");
}

// Returns what a file is that only looks like a mesh or an image by its name, and what to do; empty
// if nothing is known against it.
std::string_view foreign_kind(std::string_view bytes) {
  if (bytes.starts_with("version https://git-lfs.github.com/spec/")) {
    return "the file is a Git LFS pointer, which only names its content; run `git lfs pull` in its "
           "repository";
  }
  if (bytes.starts_with("\x1F\x8B")) {
    return "the file is compressed by gzip; decompress it first";
  }
  if (bytes.starts_with("PK\x03\x04")) {
    return "the file is a zip archive; unpack it, and choose a file in it";
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  const std::string start = lowered(bytes.substr(0, 14));
  if (start == "<!doctype html" || start.starts_with("<html")) {
    return "the file is a web page (HTML); download the file itself, not the page that shows it";
  }
  return {};
}

}  // namespace

FileBytes FileBytes::read_data(const std::filesystem::path& path) {
  FileBytes bytes = read(path);
  const std::string_view kind = foreign_kind(bytes.view());
  if (!kind.empty()) throw InputError(path.string() + ": " + std::string(kind));
  return bytes;
}

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
