#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

#include "files/file_purpose.h"
#include "lapwing/io/file_bytes.h"

namespace lapwing::viewer {

/// A desktop program that shows a file dialog.
struct DialogProgram {
  enum class Kind { zenity, kdialog } kind = Kind::zenity;
  std::filesystem::path path;
};

/// Prefers kdialog on KDE and zenity on other desktops. If the preferred program is not on $PATH,
/// returns the other one. Returns nullopt if neither is on $PATH, or if there is no display
/// ($DISPLAY, $WAYLAND_DISPLAY).
std::optional<DialogProgram> find_dialog_program();

/// The arguments of a file dialog.
struct DialogRequest {
  PathPurpose purpose = PathPurpose::open;
  std::filesystem::path folder;  ///< start folder, absolute
  std::string name;              ///< suggested name of a new file
};

/// Returns the command line of the dialog: the program and its arguments.
std::vector<std::string> dialog_command(const DialogProgram& program, const DialogRequest& request);

struct DialogAnswer {
  enum class What { chosen, cancelled, failed } what = What::cancelled;
  std::filesystem::path path;  ///< the chosen path; empty unless `chosen`
  std::string reason;          ///< reason of a failure, such as "zenity: cannot open display"
};

/// A file dialog of the desktop, run as a child process without a shell. A background thread reads
/// the answer and then calls `wake`. The destructor kills the process and its children.
class SystemDialog {
 public:
  /// Throws IoError if the program cannot be started.
  explicit SystemDialog(const std::vector<std::string>& command, std::function<void()> wake = {});
  ~SystemDialog();
  SystemDialog(const SystemDialog&) = delete;
  SystemDialog& operator=(const SystemDialog&) = delete;

  /// Returns the answer once after the dialog has ended; otherwise returns nullopt.
  std::optional<DialogAnswer> take();

 private:
  void wait_for_answer();

  std::string name_;  // name of the program, for messages
  pid_t process_ = -1;
  std::optional<FileDescriptor> output_;
  std::optional<FileDescriptor> errors_;
  std::optional<FileDescriptor> stop_;  // becomes readable when the destructor runs
  std::function<void()> wake_;
  std::mutex mutex_;
  std::optional<DialogAnswer> answer_;  // guarded by the mutex
  std::thread thread_;                  // declared last, because it uses all other members
};

}  // namespace lapwing::viewer
