#include "support/models.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace lapwing::test {

namespace fs = std::filesystem;

fs::path models_folder() {
  const char* const elsewhere = std::getenv("LAPWING_TEST_MODELS");
  return elsewhere != nullptr ? elsewhere : LAPWING_MODELS_DIR;
}

std::vector<fs::path> model_files(const std::string& package) {
  const fs::path folder = models_folder() / package;
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const std::array known{".obj", ".off", ".ply", ".stl"};
    if (std::find(known.begin(), known.end(), extension) != known.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace lapwing::test
