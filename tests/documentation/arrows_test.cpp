// Tests the dependencies between folders, which the READMEs show as arrows.
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const fs::path kSources(LAPWING_SOURCE_FOLDER);

// Maps each folder to the folders that its sources include. The string is an example of an include.
using Arrows = std::map<fs::path, std::map<fs::path, std::string>>;

// Returns the path of the project's header `name`, or an empty path for other headers.
fs::path header_named(const std::string& name) {
  for (const char* folder : {"engine", "viewer", "tools/bench", "tools/lapwing"}) {
    if (fs::exists(kSources / folder / name)) return fs::path(folder) / name;
  }
  return {};
}

// Returns the folder of a source. Modifiers count as part of the folder of their operation.
fs::path folder_of(const fs::path& source) {
  const fs::path folder = source.parent_path();
  return folder.filename() == "modifiers" ? folder.parent_path() : folder;
}

void add_arrows(const fs::path& source, Arrows& arrows) {
  const fs::path folder = folder_of(source).lexically_relative(kSources);
  std::ifstream file(source);
  const std::string begin = "#include \"";
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(begin)) continue;
    const std::string name = line.substr(begin.size(), line.rfind('"') - begin.size());
    const fs::path header = header_named(name);
    if (header.empty() || folder_of(header) == folder) continue;
    arrows[folder][folder_of(header)] = source.filename().string() + " includes " + name;
  }
}

Arrows all_arrows() {
  Arrows arrows;
  for (const char* root : {"engine/lapwing", "viewer", "tools/bench", "tools/lapwing"}) {
    for (const auto& file : fs::recursive_directory_iterator(kSources / root)) {
      const fs::path extension = file.path().extension();
      if (extension == ".h" || extension == ".cpp") add_arrows(file.path(), arrows);
    }
  }
  // lapwing.h includes the whole engine.
  arrows.erase("engine/lapwing");
  return arrows;
}

// Repeatedly removes folders that include no remaining folder. Each folder that remains is part of
// a cycle or depends on one.
Arrows without_ends(Arrows arrows) {
  for (bool found = true; found;) {
    found = false;
    for (auto& [folder, included] : arrows) {
      found = std::erase_if(included,
                            [&](const auto& arrow) { return !arrows.contains(arrow.first); }) > 0 ||
              found;
    }
    found =
        std::erase_if(arrows, [](const auto& entry) { return entry.second.empty(); }) > 0 || found;
  }
  return arrows;
}

TEST(Arrows, FoldersIncludeEachOtherInNoCircle) {
  std::vector<std::string> circles;
  for (const auto& [folder, included] : without_ends(all_arrows())) {
    for (const auto& [other, example] : included) {
      circles.push_back(folder.string() + ": " + example);
    }
  }
  EXPECT_THAT(circles, IsEmpty());
}

TEST(Arrows, TheEngineIncludesNothingOfItsUsers) {
  const Arrows arrows = all_arrows();
  EXPECT_THAT(arrows, SizeIs(::testing::Gt(30U))) << "the sources were found";
  for (const auto& [folder, included] : arrows) {
    if (!folder.string().starts_with("engine/")) continue;
    for (const auto& [other, example] : included) {
      EXPECT_TRUE(other.string().starts_with("engine/")) << folder << ": " << example;
    }
  }
}

}  // namespace
}  // namespace lapwing
