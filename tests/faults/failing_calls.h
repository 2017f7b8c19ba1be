#pragma once

#include <string_view>

namespace lapwing::test {

/// The system calls by which our code makes files. Only files that are opened for writing and
/// written to count.
enum class FileCall { open, write, fsync, fchmod, linkat, rename };
inline constexpr FileCall kFileCalls[] = {FileCall::open,   FileCall::write,  FileCall::fsync,
                                          FileCall::fchmod, FileCall::linkat, FileCall::rename};
std::string_view name_of(FileCall call);

/// While alive, has call number `fail_at` (from 0) of `call` fail with `error`. A failing write
/// first writes half of what it was given, as on a disk that fills up.
class FailingCall {
 public:
  FailingCall(FileCall call, long fail_at, int error);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Whether it came to that.
  static bool has_failed();
};

/// While alive, no file without a name can be made: as on a file system that knows none.
class NoNamelessFiles {
 public:
  NoNamelessFiles();
  ~NoNamelessFiles();
  NoNamelessFiles(const NoNamelessFiles&) = delete;
  NoNamelessFiles& operator=(const NoNamelessFiles&) = delete;
};

}  // namespace lapwing::test
