#include "state/append_file.h"

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace lapwing::viewer {
namespace {

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file, bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
  return true;
}

}  // namespace

bool append(FileDescriptor& file, std::string_view bytes) {
  const off_t before = ::lseek(file.get(), 0, SEEK_END);
  if (write_all(file.get(), bytes) && ::fsync(file.get()) == 0) return true;
  const int error = errno;
  if (::ftruncate(file.get(), before) != 0) file.close();
  errno = error;
  return false;
}

void flush_folder(const std::filesystem::path& folder) {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file.is_open()) ::fsync(file.get());
}

}  // namespace lapwing::viewer
