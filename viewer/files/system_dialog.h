#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

#include "files/file_purpose.h"
#include "lapwing/io/file_descriptor.h"

namespace lapwing::viewer {

/// A program of the desktop that asks for a file in a window of its own.
struct DialogProgram {
  enum class Kind { zenity, kdialog } kind = Kind::zenity;
  std::filesystem::path path;
};

/// The one to use here: kdialog on KDE, zenity elsewhere, the other one where that is not on $PATH.
/// Nothing without either, and without a display ($DISPLAY, $WAYLAND_DISPLAY).
std::optional<DialogProgram> find_dialog_program();

/// What it is to ask for.
struct DialogRequest {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path folder;  ///< where it begins, absolute
  std::string name;              ///< suggested for a new file
};

/// The program and its arguments.
std::vector<std::string> dialog_command(const DialogProgram& program, const DialogRequest& request);

struct DialogAnswer {
  enum class What { chosen, cancelled, failed } what = What::cancelled;
  std::filesystem::path path;  ///< where one was chosen
  std::string reason;          ///< of what failed: "zenity: cannot open display"
};

/// A dialog of the desktop, a process of its own without a shell. Nothing here waits for it: a
/// thread reads its answer, and calls `wake` when that is there. When this goes the process is
/// ended, and whatever it started.
class SystemDialog {
 public:
  /// Throws IoError when the program cannot be started.
  explicit SystemDialog(const std::vector<std::string>& command, std::function<void()> wake = {});
  ~SystemDialog();
  SystemDialog(const SystemDialog&) = delete;
  SystemDialog& operator=(const SystemDialog&) = delete;

  /// The answer, once; nothing while the person chooses.
  std::optional<DialogAnswer> take();

 private:
  void wait_for_answer();

  std::string name_;  // of the program, for messages
  pid_t process_ = -1;
  std::optional<FileDescriptor> output_;
  std::optional<FileDescriptor> errors_;
  std::optional<FileDescriptor> stop_;  // readable once this goes
  std::function<void()> wake_;
  std::mutex mutex_;
  std::optional<DialogAnswer> answer_;  // guarded by the mutex
  std::thread thread_;                  // last: it uses all the others
};

}  // namespace lapwing::viewer
