#include "lapwing/io/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lapwing/base/errors.h"
#include "lapwing/io/paths.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kPermissions = 07777;
constexpr mode_t kPrivate = 0600;

[[noreturn]] void fail_to_write(const fs::path& path, int error) {
  const std::string what = "cannot write " + path.string() + ": " + std::strerror(error);
  if (error == ENOENT) {
    throw IoError(what + "; create the folder " + path.parent_path().string() +
                  " or choose another");
  }
  throw IoError(what +
                "; the old file, if there is one, is unchanged. Choose another place, or free some "
                "space and try again");
}

fs::path folder_of(const fs::path& target) {
  return target.parent_path();
}

// Returns the permissions of the file at `target`, or nullopt if there is no file. Throws IoError
// if that file cannot be replaced. The message names `path`, the path that the user gave.
std::optional<mode_t> old_permissions(const fs::path& target, const fs::path& path) {
  struct stat old {};
  if (::stat(target.c_str(), &old) != 0) {
    if (errno != ENOENT) fail_to_write(path, errno);
    return std::nullopt;
  }
  if (S_ISDIR(old.st_mode)) fail_to_write(path, EISDIR);
  if (!S_ISREG(old.st_mode)) {
    throw IoError("cannot write " + path.string() + ": not a regular file; choose another name");
  }
  // A rename needs permission only for the directory, but a read-only file must stay.
  if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0) fail_to_write(path, errno);
  return old.st_mode & kPermissions;
}

// Makes the rename survive a power cut. Errors are ignored: the file itself is complete.
void flush_directory(const fs::path& target) {
  const FileDescriptor directory(
      ::open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (directory.is_open()) ::fsync(directory.get());
}

bool is_same_open_file(int descriptor, const fs::path& path) {
  struct stat open {};
  struct stat named {};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

// Marks a temporary file as in use while its process lives.
bool lock(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// Removes the temporary file of a killed process. Returns false if `path` is something else.
bool remove_stale(const fs::path& path) {
  const FileDescriptor file(::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  const bool is_stale = file.is_open() && ::fstat(file.get(), &status) == 0 &&
                        S_ISREG(status.st_mode) && status.st_uid == ::geteuid() &&
                        lock(file.get()) && is_same_open_file(file.get(), path);
  return is_stale && ::unlink(path.c_str()) == 0;
}

}  // namespace

FileReplacement::FileReplacement(const fs::path& path, Unopened /*unused*/)
    : named_(path), target_(real_path(path)), old_permissions_(old_permissions(target_, path)) {}

// Delegates to the other constructor, so that the destructor runs even if opening the file throws.
FileReplacement::FileReplacement(const fs::path& path) : FileReplacement(path, Unopened{}) {
  if (!open_without_name()) open_with_name();
  make_private();
}

FileReplacement::~FileReplacement() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

const fs::path& FileReplacement::temporary() {
  if (path_.empty()) name_it();
  return path_;
}

void FileReplacement::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t put = ::write(file_.get(), bytes.data(), bytes.size());
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) fail_to_write(named_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(put));
  }
}

void FileReplacement::flush() {
  if (::fchmod(file_.get(), permissions_) != 0) fail_to_write(named_, errno);
  if (::fsync(file_.get()) != 0) fail_to_write(named_, errno);
}

void FileReplacement::commit() {
  flush();
  // If there is no old file, link the temporary file directly to the target's name.
  if (path_.empty() && !old_permissions_ && link_to(target_)) return flush_directory(target_);
  if (path_.empty()) name_it();
  if (std::rename(path_.c_str(), target_.c_str()) != 0) fail_to_write(named_, errno);
  path_.clear();
  flush_directory(target_);
}

std::string FileReplacement::link_of_descriptor() const {
  return "/proc/self/fd/" + std::to_string(file_.get());
}

// Not every file system has unnamed files, and without /proc they cannot be named later.
bool FileReplacement::open_without_name() {
  file_.reset(::open(folder_of(target_).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (!file_.is_open() || ::access(link_of_descriptor().c_str(), F_OK) != 0) return false;
  lock(file_.get());
  return true;
}

// Tries names until `take` returns true. If `take` returns false, it has set errno.
template <class Take>
void FileReplacement::for_each_name(const Take& take) {
  for (int number = 0;; ++number) {
    fs::path name = target_;
    name += ".tmp-" + std::to_string(number);
    do {
      if (take(name)) return;
      if (errno != EEXIST) fail_to_write(named_, errno);
    } while (remove_stale(name));
  }
}

void FileReplacement::open_with_name() {
  for_each_name([&](const fs::path& name) {
    file_.reset(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
    if (!file_.is_open()) return false;
    path_ = name;
    lock(file_.get());
    // Between open and lock, another process may have removed the file as stale.
    if (is_same_open_file(file_.get(), name)) return true;
    path_.clear();
    errno = EEXIST;
    return false;
  });
}

void FileReplacement::name_it() {
  for_each_name([&](const fs::path& name) {
    if (!link_to(name)) return false;
    path_ = name;
    return true;
  });
}

bool FileReplacement::link_to(const fs::path& name) {
  if (::linkat(AT_FDCWD, link_of_descriptor().c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) ==
      0) {
    return true;
  }
  if (errno != EEXIST) fail_to_write(named_, errno);
  return false;
}

// Hides the file until `flush` gives it its permissions: those of the old file, or the system's
// default for a new one.
void FileReplacement::make_private() {
  struct stat given {};
  if (::fstat(file_.get(), &given) != 0) fail_to_write(named_, errno);
  permissions_ = old_permissions_.value_or(given.st_mode & kPermissions);
  if (::fchmod(file_.get(), kPrivate) != 0) fail_to_write(named_, errno);
}

void require_replaceable(const fs::path& path) {
  const fs::path target = real_path(path);
  old_permissions(target, path);
  if (::faccessat(AT_FDCWD, folder_of(target).c_str(), W_OK | X_OK, AT_EACCESS) != 0) {
    fail_to_write(path, errno);
  }
}

void replace_file(const fs::path& path, std::string_view bytes) {
  FileReplacement replacement(path);
  replacement.write(bytes);
  replacement.commit();
}

void FileReplacements::add(const fs::path& path, std::string_view bytes) {
  auto file = std::make_unique<FileReplacement>(path);
  file->write(bytes);
  file->flush();
  files_.push_back(std::move(file));
}

void FileReplacements::commit() {
  std::string in_place;
  for (const auto& file : files_) {
    try {
      file->commit();
    } catch (const IoError& error) {
      if (in_place.empty()) throw;
      throw IoError(std::string(error.what()) + ". Already written: " + in_place);
    }
    in_place += (in_place.empty() ? "" : ", ") + file->path().string();
  }
  files_.clear();
}

}  // namespace lapwing
