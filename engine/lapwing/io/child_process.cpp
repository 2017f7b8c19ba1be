#include "lapwing/io/child_process.h"

#include <cstdlib>
#include <fcntl.h>
#include <spawn.h>
#include <system_error>
#include <unistd.h>

#include "lapwing/base/errors.h"

extern char** environ;

namespace lapwing {
namespace {

namespace fs = std::filesystem;

void connect(posix_spawn_file_actions_t& files, int stream, int descriptor) {
  if (descriptor >= 0) {
    posix_spawn_file_actions_adddup2(&files, descriptor, stream);
  } else {
    posix_spawn_file_actions_addopen(&files, stream, "/dev/null",
                                     stream == STDIN_FILENO ? O_RDONLY : O_WRONLY, 0);
  }
}

}  // namespace

std::optional<fs::path> find_program(std::string_view name) {
  const char* variable = std::getenv("PATH");
  std::string_view folders = variable != nullptr ? variable : "";
  while (!folders.empty()) {
    const auto colon = folders.find(':');
    const std::string_view folder = folders.substr(0, colon);
    folders.remove_prefix(colon == std::string_view::npos ? folders.size() : colon + 1);
    if (!folder.starts_with('/')) continue;
    fs::path path = fs::path(folder) / name;
    std::error_code error;
    if (fs::is_regular_file(path, error) && access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

pid_t start_child(const std::vector<std::string>& command, const ChildStreams& streams) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  connect(files, STDIN_FILENO, streams.input);
  connect(files, STDOUT_FILENO, streams.output);
  connect(files, STDERR_FILENO, streams.errors);
#if defined(__GLIBC_PREREQ)
#if __GLIBC_PREREQ(2, 34)
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
#endif
#endif
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  pid_t process = -1;
  const int failed =
      posix_spawn(&process, arguments[0], &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) {
    throw IoError("cannot start " + command[0] + ": " + std::generic_category().message(failed));
  }
  return process;
}

}  // namespace lapwing
