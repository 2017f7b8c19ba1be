#pragma once

#include <string_view>

namespace lapwing::test {

/// The system calls that our code uses to write files. Calls for other files are not counted.
enum class FileCall { open, write, fsync, fchmod, linkat, rename };
inline constexpr FileCall kFileCalls[] = {FileCall::open,   FileCall::write,  FileCall::fsync,
                                          FileCall::fchmod, FileCall::linkat, FileCall::rename};
std::string_view name_of(FileCall call);

/// While this object exists, the system call `call` with the index `fail_at` (counted from 0) fails
/// with `error`. A write that fails first writes half of its bytes, as on a disk that becomes full.
class FailingCall {
 public:
  FailingCall(FileCall call, long fail_at, int error);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Returns whether the call has failed.
  static bool has_failed();
};

/// While this object exists, unnamed files (O_TMPFILE) cannot be created, as on some file systems.
class NoNamelessFiles {
 public:
  NoNamelessFiles();
  ~NoNamelessFiles();
  NoNamelessFiles(const NoNamelessFiles&) = delete;
  NoNamelessFiles& operator=(const NoNamelessFiles&) = delete;
};

}  // namespace lapwing::test
