#pragma once

#include <string_view>

namespace lapwing::test {

/// The system calls by which our code writes files. Calls for other files are not counted.
enum class FileCall { open, write, fsync, fchmod, linkat, rename };
inline constexpr FileCall kFileCalls[] = {FileCall::open,   FileCall::write,  FileCall::fsync,
                                          FileCall::fchmod, FileCall::linkat, FileCall::rename};
std::string_view name_of(FileCall call);

/// While it exists, call number `fail_at` (from 0) of `call` fails with `error`. A failing write
/// first writes half of its bytes, as on a disk that fills up.
class FailingCall {
 public:
  FailingCall(FileCall call, long fail_at, int error);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Returns whether the call has failed.
  static bool has_failed();
};

/// While it exists, files cannot be created without a name, as on some file systems.
class NoNamelessFiles {
 public:
  NoNamelessFiles();
  ~NoNamelessFiles();
  NoNamelessFiles(const NoNamelessFiles&) = delete;
  NoNamelessFiles& operator=(const NoNamelessFiles&) = delete;
};

}  // namespace lapwing::test
