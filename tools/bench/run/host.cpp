#include "run/host.h"

#include <ctime>
#include <fstream>
#include <string>
#include <unistd.h>

#include "lapwing/base/parallel.h"

namespace lapwing::bench {
namespace {

// Returns the unquoted value after `key` and `separator` in a file of such lines; empty if no line
// has the key.
std::string value_in(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find(separator);
    if (at == std::string::npos) continue;
    std::string value = line.substr(line.find_first_not_of(" \t\"", at + 1));
    while (value.ends_with('"')) value.pop_back();
    return value;
  }
  return {};
}

}  // namespace

Host this_host() {
  Host host;
  host.processor = value_in("/proc/cpuinfo", "model name", ':');
  host.threads = thread_count();
  host.memory_bytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  host.system = value_in("/etc/os-release", "PRETTY_NAME", '=');
#if defined(__clang__)
  host.compiler = "Clang " __clang_version__;
#else
  host.compiler = "GCC " __VERSION__;
#endif
  return host;
}

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  std::string text(32, '\0');
  text.resize(std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts));
  return text;
}

std::string built_from() {
  return LAPWING_COMMIT;
}

}  // namespace lapwing::bench
