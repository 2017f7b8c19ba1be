// The entry points of libFuzzer. --target=NAME selects a target, --seeds=FOLDER writes its initial
// inputs, and --list prints the names of all targets.
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "fuzz/targets.h"

namespace {

const lapwing::fuzz::Target* chosen = nullptr;

void write_seeds(std::string_view folder) {
  int number = 0;
  for (const std::string& seed : chosen->seeds()) {
    std::ofstream(std::string(folder) + "/seed-" + std::to_string(number++), std::ios::binary)
        << seed;
  }
  std::exit(0);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  std::string_view seeds;
  for (int k = 1; k < *argc; ++k) {
    const std::string_view argument = (*argv)[k];
    if (argument.starts_with("--target=")) {
      chosen = &lapwing::fuzz::target_named(argument.substr(9));
    } else if (argument.starts_with("--seeds=")) {
      seeds = argument.substr(8);
    } else if (argument == "--list") {
      for (const auto& target : lapwing::fuzz::targets()) {
        std::printf("%s\t%s\t%s\n", std::string(target.name).c_str(),
                    std::string(target.dictionary).c_str(), std::string(target.tries).c_str());
      }
      std::exit(0);
    }
  }
  if (chosen == nullptr) {
    std::fprintf(stderr, "which target? --target=NAME, of those that --list lists\n");
    std::exit(2);
  }
  if (!seeds.empty()) write_seeds(seeds);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    chosen->run({bytes, size});
  } catch (const lapwing::fuzz::Violation& violation) {
    std::fprintf(stderr, "VIOLATION: %s does not hold\n", violation.what.c_str());
    std::abort();
  }
  return 0;
}
