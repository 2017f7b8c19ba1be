#include "lapwing/base/memory_use.h"

#include <fstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace lapwing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMiB = 1024 * 1024;

// A root folder with the files that a Linux system shows of its memory.
class AvailableMemory : public ::testing::Test {
 protected:
  AvailableMemory()
      : root_(fs::path(testing::TempDir()) /
              ("lapwing-memory-" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
    fs::remove_all(root_);
    write("proc/meminfo", "MemTotal:  8388608 kB\nMemAvailable:   4194304 kB\n");
  }
  ~AvailableMemory() override { fs::remove_all(root_); }

  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  void limit_version_2(const fs::path& group, std::size_t most, std::size_t used) const {
    write("sys/fs/cgroup" / group / "memory.max", std::to_string(most));
    write("sys/fs/cgroup" / group / "memory.current", std::to_string(used));
  }
  void limit_version_1(const fs::path& group, std::size_t most, std::size_t used) const {
    write("sys/fs/cgroup/memory" / group / "memory.limit_in_bytes", std::to_string(most));
    write("sys/fs/cgroup/memory" / group / "memory.usage_in_bytes", std::to_string(used));
  }
  std::size_t mib() const { return available_memory_bytes(root_) / kMiB; }

  const fs::path root_;
};

TEST_F(AvailableMemory, WithoutGroupsIsTheMachines) {
  EXPECT_EQ(mib(), 4096U);
}

TEST_F(AvailableMemory, IsNotKnownWhereNothingSays) {
  fs::remove_all(root_ / "proc");
  EXPECT_EQ(available_memory_bytes(root_), 0U);
}

TEST_F(AvailableMemory, OfAContainerIsWhatItsGroupLeaves) {
  write("proc/self/cgroup", "0::/\n");
  limit_version_2("", 1000 * kMiB, 300 * kMiB);
  EXPECT_EQ(mib(), 700U);
}

TEST_F(AvailableMemory, OfNestedGroupsIsTheLeastThatAnyLeaves) {
  write("proc/self/cgroup", "0::/user.slice/session/editor\n");
  limit_version_2("user.slice/session/editor", 2000 * kMiB, 100 * kMiB);
  limit_version_2("user.slice", 1500 * kMiB, 1000 * kMiB);
  write("sys/fs/cgroup/user.slice/session/memory.max", "max\n");
  EXPECT_EQ(mib(), 500U);
}

TEST_F(AvailableMemory, CountsVersion1) {
  write("proc/self/cgroup", "12:cpu,cpuacct:/jobs/7\n4:memory:/jobs/7\n1:name=systemd:/x\n");
  limit_version_1("jobs/7", 900 * kMiB, 250 * kMiB);
  limit_version_1("", 9223372036854771712U, 3000 * kMiB);
  EXPECT_EQ(mib(), 650U);
}

TEST_F(AvailableMemory, OfVersion1InAContainerIsThatOfTheMountedFolder) {
  // The container's own folder is mounted, and the path that it has outside is not there.
  write("proc/self/cgroup", "4:memory:/docker/0123abcd\n0::/docker/0123abcd\n");
  limit_version_1("", 600 * kMiB, 100 * kMiB);
  EXPECT_EQ(mib(), 500U);
}

TEST_F(AvailableMemory, TakesTheCacheOfFilesForFree) {
  write("proc/self/cgroup", "0::/\n");
  limit_version_2("", 1000 * kMiB, 900 * kMiB);
  write("sys/fs/cgroup/memory.stat", "anon 1\ninactive_file " + std::to_string(400 * kMiB) + "\n");
  EXPECT_EQ(mib(), 500U);
}

TEST_F(AvailableMemory, OfAGroupThatIsFullIsNextToNothing) {
  write("proc/self/cgroup", "0::/\n");
  limit_version_2("", 100 * kMiB, 200 * kMiB);
  EXPECT_EQ(available_memory_bytes(root_), 1U) << "0 would mean that it is not known";
}

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
