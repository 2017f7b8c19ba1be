// Runs the fuzz targets on the stored corpus and on mutations of their initial inputs. The
// mutations use fixed random seeds.
#include <fstream>
#include <random>

#include <gtest/gtest.h>

#include "fuzz/targets.h"
#include "io/temporary_folder.h"
#include "support/environment.h"

namespace lapwing::fuzz {
namespace {

namespace fs = std::filesystem;

class FuzzTarget : public ::testing::TestWithParam<Target> {
 protected:
  // Keeps the input if it fails.
  void run(const std::string& bytes) {
    try {
      GetParam().run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    } catch (const Violation& violation) {
      ADD_FAILURE() << violation.what << " does not hold of " << kept(bytes);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what() << " left the target with " << kept(bytes);
    }
  }

  static std::string kept(const std::string& bytes) {
    const fs::path path =
        fs::temp_directory_path() / ("lapwing-" + std::string(GetParam().name) + "-finding");
    std::ofstream(path, std::ios::binary) << bytes;
    return path.string();
  }
};

TEST_P(FuzzTarget, HoldsOnWhatItBeginsWith) {
  for (const std::string& seed : GetParam().seeds()) run(seed);
}

TEST_P(FuzzTarget, HoldsOnWhatWasFound) {
  const fs::path corpus = fs::path(LAPWING_FUZZ_CORPUS) / GetParam().name;
  if (!fs::is_directory(corpus)) GTEST_SKIP() << "nothing was found";
  for (const auto& entry : fs::directory_iterator(corpus)) run(content_of(entry.path()));
}

TEST_P(FuzzTarget, HoldsOnMutations) {
  const std::vector<std::string> seeds = GetParam().seeds();
  std::mt19937 random(1);  // NOLINT(cert-msc51-cpp): the same every time
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  const int runs = test::how_often("LAPWING_FUZZ_RUNS", GetParam().usual_runs);
  for (int k = 0; k < runs && !HasFailure(); ++k) {
    std::string bytes = seeds[below(seeds.size())];
    for (std::size_t change = 0; change <= below(6) && !bytes.empty(); ++change) {
      const std::size_t at = below(bytes.size());
      switch (below(5)) {
        case 0:
          bytes[at] = static_cast<char>(random());
          break;
        case 1:
          bytes.erase(at, 1 + below(8));
          break;
        case 2:
          bytes.resize(at);
          break;
        case 3:
          bytes.insert(at, bytes.substr(below(bytes.size()), below(20)));
          break;
        default:
          bytes[at] = "0123456789-+.e/ \n#n\""[below(20)];
      }
    }
    run(bytes);
  }
}

INSTANTIATE_TEST_SUITE_P(All, FuzzTarget, ::testing::ValuesIn(targets().begin(), targets().end()),
                         [](const auto& named) { return std::string(named.param.name); });

}  // namespace
}  // namespace lapwing::fuzz
