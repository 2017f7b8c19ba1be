#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace lapwing::test {

/// Bends tube.obj, of height 3, by its upper end.
inline constexpr const char* kBendTube = R"({"lapwing": 1, "mesh": "tube.obj", "steps": [
      {"op": "deform", "roi": {"all": true},
       "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.4]}},
       "handles": [{"region": {"box": {"min": [-1, -1, 2.8], "max": [1, 1, 4]}},
                    "move": {"translate": [0, 0, 0.5]}}]}]})";

/// The bytes of each file, by its name.
using Files = std::map<std::string, std::string>;
inline Files files_in(const std::filesystem::path& folder) {
  Files files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    files[entry.path().filename().string()] = text.str();
  }
  return files;
}

}  // namespace lapwing::test
