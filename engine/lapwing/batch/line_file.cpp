#include "lapwing/batch/line_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int error) {
  throw IoError("cannot write " + path.string() + ": " + std::strerror(error));
}

}  // namespace

LineFile::LineFile(fs::path path)
    : path_(std::move(path)),
      // Without O_NONBLOCK, opening a pipe would wait for a reader.
      file_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_NONBLOCK | O_CLOEXEC, 0666)) {
  if (!file_.is_open()) fail(path_, errno);
  // On file systems without locks, two runs that write to the same folder are not detected.
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    throw IoError(path_.string() +
                  ": another run is writing it; wait until it ends, or choose another folder");
  }
  const FileBytes bytes = FileBytes::read(path_);
  const std::size_t whole = bytes.view().rfind('\n') + 1;  // 0 for none
  if (whole < bytes.view().size() && ::ftruncate(file_.get(), static_cast<off_t>(whole)) != 0) {
    fail(path_, errno);
  }
}

void LineFile::append(std::string line) {
  line += '\n';
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t put = ::write(file_.get(), rest.data(), rest.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail(path_, errno);
    rest.remove_prefix(static_cast<std::size_t>(put));
  }
}

void for_each_line(const fs::path& path, const std::function<void(std::string_view)>& take) {
  if (!fs::exists(path)) return;
  const FileBytes bytes = FileBytes::read(path);
  std::string_view rest = bytes.view();
  for (std::size_t end = rest.find('\n'); end != std::string_view::npos; end = rest.find('\n')) {
    take(rest.substr(0, end));
    rest.remove_prefix(end + 1);
  }
}

}  // namespace lapwing
