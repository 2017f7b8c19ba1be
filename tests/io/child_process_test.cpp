#include "lapwing/io/child_process.h"

#include <array>
#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/file_bytes.h"
#include "support/environment.h"

namespace lapwing {
namespace {

class ChildProcess : public ::testing::Test {
 protected:
  std::filesystem::path program(const std::string& name, const std::string& script) {
    const auto path = folder_.file(name, "#!/bin/sh\n" + script);
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
  }
  static int exit_code_of(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder folder_;
};

TEST_F(ChildProcess, IsFoundInTheFirstAbsoluteFolderThatHasIt) {
  const auto found = program("painter", "exit 0\n");
  folder_.file("scribbler", "nobody may run it");
  const test::Environment path("PATH", "relative:/nowhere:" + folder_.path().string());
  EXPECT_EQ(find_program("painter"), found);
  EXPECT_FALSE(find_program("scribbler"));
  EXPECT_FALSE(find_program("nobody"));
}

TEST_F(ChildProcess, ReadsAndWritesWhatItIsGiven) {
  const FileDescriptor input(open(folder_.file("in", "three words here").c_str(), O_RDONLY));
  const FileDescriptor output(
      open(folder_.file("out", "").c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  const pid_t child = start_child({program("counter", "wc -w; exit 7\n").string()},
                                  {.input = input.get(), .output = output.get()});
  EXPECT_EQ(exit_code_of(child), 7);
  EXPECT_EQ(std::stoi(content_of(folder_ / "out")), 3);
}

TEST_F(ChildProcess, IsInAGroupOfItsOwn) {
  const pid_t child = start_child({program("sleeper", "exec sleep 60\n").string()}, {});
  EXPECT_EQ(getpgid(child), child);
  EXPECT_EQ(kill(-child, SIGKILL), 0);
  EXPECT_EQ(exit_code_of(child), -1);
}

TEST_F(ChildProcess, ThatIsNotThereIsAnError) {
  EXPECT_THROW(start_child({(folder_ / "nobody").string()}, {}), IoError);
}

}  // namespace
}  // namespace lapwing
