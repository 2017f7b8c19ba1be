#include "lapwing/io/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/file_descriptor.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail_to_write(const fs::path& path, int error) {
  throw IoError("cannot write " + path.string() + ": " + std::strerror(error) +
                "; nothing was changed, choose another place or make room and try again");
}

// The file that a write to `path` reaches, also when it is a link to a file yet to be made.
fs::path resolve_links(fs::path path) {
  constexpr int kMostLinks = 40;  // as the kernel's own limit
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(path, error)); ++links) {
    if (links == kMostLinks) fail_to_write(path, ELOOP);
    const fs::path next = fs::read_symlink(path, error);
    if (error) fail_to_write(path, error.value());
    path = path.parent_path() / next;
  }
  return path;
}

// Makes the rename itself survive a power cut. Some file systems cannot; the file is then whole
// all the same.
void flush_directory(const fs::path& target) {
  const fs::path parent = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const FileDescriptor directory(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.is_open()) ::fsync(directory.get());
}

}  // namespace

// A file beside the target that is gone at the end unless it was renamed over the target.
class FileReplacement::Temporary {
 public:
  explicit Temporary(const fs::path& target) : target_(target), file_(create()) {}
  ~Temporary() {
    if (!renamed_) ::unlink(path_.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t put = ::write(file_.get(), bytes.data(), bytes.size());
      if (put < 0 && errno == EINTR) continue;
      if (put < 0) fail_to_write(target_, errno);
      bytes.remove_prefix(static_cast<std::size_t>(put));
    }
  }

  const fs::path& path() const { return path_; }
  const fs::path& target() const { return target_; }

  void set_permissions(mode_t mode) {
    if (::fchmod(file_.get(), mode & 07777U) != 0) fail_to_write(target_, errno);
  }

  void rename_to_target() {
    if (::fsync(file_.get()) != 0) fail_to_write(target_, errno);
    if (!file_.close()) fail_to_write(target_, errno);
    if (std::rename(path_.c_str(), target_.c_str()) != 0) fail_to_write(target_, errno);
    renamed_ = true;
  }

 private:
  int create() {
    static std::atomic<unsigned> serial{0};
    for (;;) {
      path_ = target_;
      path_ += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(serial++);
      const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor >= 0) return descriptor;
      if (errno != EEXIST) fail_to_write(target_, errno);
    }
  }

  fs::path target_;
  fs::path path_;
  bool renamed_ = false;
  FileDescriptor file_;
};

FileReplacement::FileReplacement(const fs::path& path) {
  const fs::path target = resolve_links(path);
  struct stat old {};
  const bool exists = ::stat(target.c_str(), &old) == 0;
  if (exists && S_ISDIR(old.st_mode)) fail_to_write(path, EISDIR);
  if (exists && !S_ISREG(old.st_mode)) {
    throw IoError("cannot write " + path.string() + ": not a regular file; name another");
  }
  // A rename needs only the directory's permission; a file marked read-only is to stay.
  if (exists && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) {
    fail_to_write(path, errno);
  }
  temporary_ = std::make_unique<Temporary>(target);
  if (exists) temporary_->set_permissions(old.st_mode);
}

FileReplacement::~FileReplacement() = default;

const fs::path& FileReplacement::temporary() const {
  return temporary_->path();
}

void FileReplacement::write(std::string_view bytes) {
  temporary_->write(bytes);
}

void FileReplacement::commit() {
  temporary_->rename_to_target();
  flush_directory(temporary_->target());
}

void replace_file(const fs::path& path, std::string_view bytes) {
  FileReplacement replacement(path);
  replacement.write(bytes);
  replacement.commit();
}

}  // namespace lapwing
