#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace lapwing {

/// The program of that name on $PATH, if there is one. Folders that are not absolute are passed
/// over: they depend on where this program was started.
std::optional<std::filesystem::path> find_program(std::string_view name);

/// The descriptors that a child reads and writes; -1: there is nothing to read, or nobody reads it.
struct ChildStreams {
  int input = -1;
  int output = -1;
  int errors = -1;
};

/// Starts `command`, a program's path and its arguments, with nothing else that this program has
/// open, and in a process group of its own: an interrupt from the terminal is not for it. The
/// caller's to wait for. Throws IoError, with the reason, where it cannot be started.
pid_t start_child(const std::vector<std::string>& command, const ChildStreams& streams);

}  // namespace lapwing
