#include "run/host.h"

#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

#include "lapwing/base/instruction_set.h"
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

constexpr const char* kChosenKernels = "OPENBLAS_CORETYPE";
// OpenBLAS's choice for an unknown x86-64 processor.
constexpr std::string_view kKernelsForUnknown = "Prescott";

// Returns an empty name if the program has another BLAS or none.
std::string_view kernels_of_blas() {
  using CoreName = char* (*)();
  const auto name = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return name != nullptr ? name() : "";
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

void require_fitting_blas(char** arguments) {
  if (std::getenv(kChosenKernels) != nullptr || kernels_of_blas() != kKernelsForUnknown) return;
  const InstructionSet best = available_instruction_sets().front();
  if (best == InstructionSet::baseline) return;
  setenv(kChosenKernels, best == InstructionSet::avx512 ? "SkylakeX" : "Haswell", 1);
  execv("/proc/self/exe", arguments);  // if this fails, the program goes on unchanged
}

}  // namespace lapwing::bench
