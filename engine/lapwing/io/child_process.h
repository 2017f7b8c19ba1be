#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace lapwing {

/// Finds an executable on $PATH. Skips relative folders, because they depend on the current folder.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// Descriptors for the child's standard streams; -1 stands for /dev/null.
struct ChildStreams {
  int input = -1;
  int output = -1;
  int errors = -1;
};

/// Starts `command`, a program's path and its arguments, in a new process group, so that an
/// interrupt from the terminal does not reach it. The child inherits no other open files. The
/// caller must wait for the process. Throws IoError with the reason if it cannot be started.
pid_t start_child(const std::vector<std::string>& command, const ChildStreams& streams);

}  // namespace lapwing
