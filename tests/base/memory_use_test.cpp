#include "lapwing/base/memory_use.h"

#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "io/temporary_folder.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMiB = 1024 * 1024;

struct System {
  std::string name;
  std::vector<std::pair<fs::path, std::string>> files;  ///< path and text, without /proc/meminfo
  std::size_t available;                                ///< expected result in bytes

  friend void PrintTo(const System& system, std::ostream* out) { *out << system.name; }
};

std::string mib(std::size_t count) {
  return std::to_string(count * kMiB) + "\n";
}

// The system files of machines on which 4 GiB are available. The last system is a container: it
// mounts its own control group, but /proc shows the path of that group on the host.
const std::vector<System> kSystems{
    {"NoGroups", {}, 4096 * kMiB},
    {"GroupOfAContainer",
     {{"proc/self/cgroup", "0::/\n"},
      {"sys/fs/cgroup/memory.max", mib(1000)},
      {"sys/fs/cgroup/memory.current", mib(300)}},
     700 * kMiB},
    {"NestedGroups",
     {{"proc/self/cgroup", "0::/user.slice/session/editor\n"},
      {"sys/fs/cgroup/user.slice/session/editor/memory.max", mib(2000)},
      {"sys/fs/cgroup/user.slice/session/editor/memory.current", mib(100)},
      {"sys/fs/cgroup/user.slice/memory.max", mib(1500)},
      {"sys/fs/cgroup/user.slice/memory.current", mib(1000)},
      {"sys/fs/cgroup/user.slice/session/memory.max", "max\n"}},
     500 * kMiB},
    {"FileCacheIsFree",
     {{"proc/self/cgroup", "0::/\n"},
      {"sys/fs/cgroup/memory.max", mib(1000)},
      {"sys/fs/cgroup/memory.current", mib(900)},
      {"sys/fs/cgroup/memory.stat", "anon 1\ninactive_file " + mib(400)}},
     500 * kMiB},
    {"FullGroupIsNotUnknown",
     {{"proc/self/cgroup", "0::/\n"},
      {"sys/fs/cgroup/memory.max", mib(100)},
      {"sys/fs/cgroup/memory.current", mib(200)}},
     1},
    {"Version1",
     {{"proc/self/cgroup", "12:cpu,cpuacct:/jobs/7\n4:memory:/jobs/7\n1:name=systemd:/x\n"},
      {"sys/fs/cgroup/memory/jobs/7/memory.limit_in_bytes", mib(900)},
      {"sys/fs/cgroup/memory/jobs/7/memory.usage_in_bytes", mib(250)},
      {"sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n"},
      {"sys/fs/cgroup/memory/memory.usage_in_bytes", mib(3000)}},
     650 * kMiB},
    {"Version1InAContainer",
     {{"proc/self/cgroup", "4:memory:/docker/0123abcd\n0::/docker/0123abcd\n"},
      {"sys/fs/cgroup/memory/memory.limit_in_bytes", mib(600)},
      {"sys/fs/cgroup/memory/memory.usage_in_bytes", mib(100)}},
     500 * kMiB},
};

class AvailableMemory : public ::testing::TestWithParam<System> {};

TEST_P(AvailableMemory, IsTheLeastThatMachineAndGroupsLeave) {
  const TemporaryFolder root;
  EXPECT_EQ(available_memory_bytes(root.path()), 0U) << "unknown";
  auto files = GetParam().files;
  files.emplace_back("proc/meminfo", "MemTotal:  8388608 kB\nMemAvailable:   4194304 kB\n");
  for (const auto& [name, text] : files) {
    fs::create_directories((root.path() / name).parent_path());
    root.file(name.string(), text);
  }
  EXPECT_EQ(available_memory_bytes(root.path()), GetParam().available);
}

INSTANTIATE_TEST_SUITE_P(All, AvailableMemory, ::testing::ValuesIn(kSystems),
                         [](const auto& test) { return test.param.name; });

TEST(AvailableMemoryOfThisProcess, IsNoMoreThanItsOwnLimitLeaves) {
  std::ifstream statm("/proc/self/statm");
  std::size_t pages = 0;
  for (int field = 0; field < 6; ++field) statm >> pages;  // the last one counts data
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_DATA, &before), 0);
  rlimit low = before;
  low.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + 64 * kMiB;
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &low), 0);
  const std::size_t left = available_memory_bytes();
  ASSERT_EQ(setrlimit(RLIMIT_DATA, &before), 0);
  EXPECT_LE(left, 65 * kMiB);
  EXPECT_GE(left, 32 * kMiB);
}

}  // namespace
}  // namespace lapwing
