#include "faults/failing_calls.h"

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>

#include "support/failing_new.h"

namespace lapwing::test {
namespace {

constexpr int kNone = -1;

std::atomic<int> failing_call{kNone};
std::atomic<long> calls_left{0};
std::atomic<int> failing_error{0};
std::atomic<bool> failed{false};
std::atomic<bool> no_nameless_files{false};

// Counts a call. Returns whether the call must fail; if so, sets errno.
bool fails(FileCall call) {
  if (failing_call != static_cast<int>(call) || calls_left.fetch_sub(1) != 0) return false;
  failed = true;
  errno = failing_error;
  return true;
}

bool is_regular_file(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

std::string_view name_of(FileCall call) {
  constexpr std::string_view kNames[] = {"open", "write", "fsync", "fchmod", "linkat", "rename"};
  return kNames[static_cast<std::size_t>(call)];
}

FailingCall::FailingCall(FileCall call, long fail_at, int error) {
  failed = false;
  failing_error = error;
  calls_left = fail_at;
  failing_call = static_cast<int>(call);
}

FailingCall::~FailingCall() {
  failing_call = kNone;
}

bool FailingCall::has_failed() {
  return failed;
}

NoNamelessFiles::NoNamelessFiles() {
  no_nameless_files = true;
}

NoNamelessFiles::~NoNamelessFiles() {
  no_nameless_files = false;
}

}  // namespace lapwing::test

using lapwing::test::allocation_fails;
using lapwing::test::fails;
using lapwing::test::FileCall;

// The linker calls these in place of the system's, which it calls __real_NAME (ld, --wrap).
extern "C" {

int __real_open(const char* path, int flags, ...);
ssize_t __real_write(int descriptor, const void* bytes, std::size_t count);
int __real_fsync(int descriptor);
int __real_fchmod(int descriptor, mode_t mode);
int __real_linkat(int old_folder, const char* old_path, int new_folder, const char* new_path,
                  int flags);
int __real_rename(const char* from, const char* to);

int __wrap_open(const char* path, int flags, ...) {
  std::va_list arguments;
  va_start(arguments, flags);
  const auto mode = static_cast<mode_t>(va_arg(arguments, unsigned));
  va_end(arguments);
  const bool is_nameless = (flags & O_TMPFILE) == O_TMPFILE;
  if (is_nameless && lapwing::test::no_nameless_files) {
    errno = EOPNOTSUPP;
    return -1;
  }
  if ((flags & O_ACCMODE) != O_RDONLY && fails(FileCall::open)) return -1;
  return __real_open(path, flags, mode);
}

ssize_t __wrap_write(int descriptor, const void* bytes, std::size_t count) {
  if (lapwing::test::is_regular_file(descriptor) && fails(FileCall::write)) {
    const int error = errno;
    static_cast<void>(__real_write(descriptor, bytes, count / 2));
    errno = error;
    return -1;
  }
  return __real_write(descriptor, bytes, count);
}

int __wrap_fsync(int descriptor) {
  if (lapwing::test::is_regular_file(descriptor) && fails(FileCall::fsync)) return -1;
  return __real_fsync(descriptor);
}

int __wrap_fchmod(int descriptor, mode_t mode) {
  return fails(FileCall::fchmod) ? -1 : __real_fchmod(descriptor, mode);
}

int __wrap_linkat(int old_folder, const char* old_path, int new_folder, const char* new_path,
                  int flags) {
  if (fails(FileCall::linkat)) return -1;
  return __real_linkat(old_folder, old_path, new_folder, new_path, flags);
}

int __wrap_rename(const char* from, const char* to) {
  return fails(FileCall::rename) ? -1 : __real_rename(from, to);
}

// Eigen's matrices and C libraries call these functions to allocate memory.
void* __real_malloc(std::size_t bytes);
void* __real_calloc(std::size_t count, std::size_t bytes);
void* __real_realloc(void* memory, std::size_t bytes);

void* __wrap_malloc(std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_malloc(bytes);
}
void* __wrap_calloc(std::size_t count, std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_calloc(count, bytes);
}
void* __wrap_realloc(void* memory, std::size_t bytes) {
  return allocation_fails() ? nullptr : __real_realloc(memory, bytes);
}

}  // extern "C"
