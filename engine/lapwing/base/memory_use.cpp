#include "lapwing/base/memory_use.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace lapwing {
namespace {

using std::filesystem::path;

constexpr std::size_t kNoLimit = std::numeric_limits<std::size_t>::max();

// Returns the number in a file, or nothing if there is none, for example "max" for no limit.
std::optional<std::size_t> number_in(const path& file_name) {
  std::ifstream file(file_name);
  std::size_t number = 0;
  if (file >> number) return number;
  return std::nullopt;
}

// Returns the number that follows `word` in a file of words and numbers.
std::optional<std::size_t> number_after(const std::string& word, const path& file_name) {
  std::ifstream file(file_name);
  std::string read;
  while (file >> read) {
    std::size_t number = 0;
    if (read == word && file >> number) return number;
  }
  return std::nullopt;
}

std::size_t what_is_left(std::size_t limit, std::size_t used) {
  return limit - std::min(limit, used);
}

// The file names of a version of control groups.
struct GroupFiles {
  const char* limit;
  const char* used;
  const char* cached;  // key in memory.stat
};

constexpr GroupFiles kVersion1 = {"memory.limit_in_bytes", "memory.usage_in_bytes",
                                  "total_inactive_file"};
constexpr GroupFiles kVersion2 = {"memory.max", "memory.current", "inactive_file"};

std::size_t left_in_group(const path& folder, const GroupFiles& files) {
  const auto limit = number_in(folder / files.limit);
  if (!limit) return kNoLimit;
  const std::size_t used = number_in(folder / files.used).value_or(0);
  const std::size_t cached = number_after(files.cached, folder / "memory.stat").value_or(0);
  return what_is_left(*limit, what_is_left(used, cached));
}

// Returns the memory left in the group at `inside` and in all enclosing groups. In a container, the
// outermost groups may be hidden, and the mounted folder may be the group itself.
std::size_t left_in_groups(const path& mounted, path inside, const GroupFiles& files) {
  std::size_t left = left_in_group(mounted, files);
  for (inside = inside.relative_path(); !inside.empty(); inside = inside.parent_path()) {
    left = std::min(left, left_in_group(mounted / inside, files));
  }
  return left;
}

// /proc/self/cgroup has lines "4:cpu,memory:/a/b" for version 1 and "0::/a/b" for version 2.
std::size_t left_to_control_groups(const path& root) {
  std::ifstream groups(root / "proc/self/cgroup");
  const path mounted = root / "sys/fs/cgroup";
  std::size_t left = left_in_group(mounted, kVersion2);
  std::string line;
  while (std::getline(groups, line)) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const path inside = line.substr(second + 1);
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    if (controllers == ",,") {
      left = std::min(left, left_in_groups(mounted, inside, kVersion2));
    } else if (controllers.find(",memory,") != std::string::npos) {
      left = std::min(left, left_in_groups(mounted / "memory", inside, kVersion1));
    }
  }
  return left;
}

// statm counts pages: size, resident, shared, text, 0, data.
std::size_t left_to_process() {
  std::ifstream statm("/proc/self/statm");
  std::size_t size = 0;
  std::size_t data = 0;
  std::size_t skipped = 0;
  if (!(statm >> size >> skipped >> skipped >> skipped >> skipped >> data)) return kNoLimit;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const auto left = [&](int kind, std::size_t pages) {
    rlimit limit{};
    if (getrlimit(static_cast<__rlimit_resource_t>(kind), &limit) != 0) return kNoLimit;
    return limit.rlim_cur == RLIM_INFINITY ? kNoLimit : what_is_left(limit.rlim_cur, pages * page);
  };
  return std::min(left(RLIMIT_AS, size), left(RLIMIT_DATA, data));
}

std::size_t available(std::size_t left, const path& root) {
  if (const auto kib = number_after("MemAvailable:", root / "proc/meminfo")) {
    left = std::min(left, *kib * 1024);
  }
  left = std::min(left, left_to_control_groups(root));
  return left == kNoLimit ? 0 : std::max<std::size_t>(left, 1);
}

}  // namespace

std::size_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // in KiB on Linux
}

std::size_t available_memory_bytes() {
  return available(left_to_process(), "/");
}

std::size_t available_memory_bytes(const path& root) {
  return available(kNoLimit, root);
}

}  // namespace lapwing
