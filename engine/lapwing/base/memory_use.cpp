#include "lapwing/base/memory_use.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <sys/resource.h>

namespace lapwing {
namespace {

// Linux: "MemAvailable:   12345 kB".
std::size_t available_to_the_machine() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::size_t kib = 0;
    if (word == "MemAvailable:" && file >> kib) return kib * 1024;
  }
  return 0;
}

// A number in a file; `otherwise` where there is none ("max" is no limit).
std::size_t number_in(const char* path, std::size_t otherwise) {
  std::ifstream file(path);
  std::size_t number = 0;
  return file >> number ? number : otherwise;
}

}  // namespace

std::size_t peak_memory_bytes() {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

std::size_t available_memory_bytes() {
  const std::size_t machine = available_to_the_machine();
  const std::size_t limit = number_in("/sys/fs/cgroup/memory.max", 0);
  if (limit == 0) return machine;
  const std::size_t used = number_in("/sys/fs/cgroup/memory.current", 0);
  return std::min(machine, limit - std::min(limit, used));
}

}  // namespace lapwing
