// The pages in the source folder, and the links between them.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/recipe/step.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::SizeIs;

const fs::path kRoot(LAPWING_SOURCE_FOLDER);

std::vector<std::string> lines_of(const fs::path& page) {
  std::ifstream file(page);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// Returns the targets of a page's links and images, relative to its folder. Ignores code blocks and
// URLs.
std::vector<std::string> links_of(const fs::path& page) {
  std::vector<std::string> links;
  bool in_code = false;
  for (const std::string& line : lines_of(page)) {
    if (line.starts_with("```")) in_code = !in_code;
    if (in_code || line.starts_with("    ")) continue;
    for (auto at = line.find("]("); at != std::string::npos; at = line.find("](", at + 2)) {
      const auto end = line.find(')', at);
      const std::string link = line.substr(at + 2, end - at - 2);
      if (link.find("://") == std::string::npos) links.push_back(link.substr(0, link.find('#')));
    }
  }
  return links;
}

fs::path target_of(const fs::path& page, const std::string& link) {
  return (page.parent_path() / link).lexically_normal();
}

std::set<fs::path> all_pages() {
  std::set<fs::path> pages{kRoot / "README.md"};
  for (const char* folder : {"engine", "shaders", "viewer", "tests", "tools"}) {
    for (const fs::path& file : fs::recursive_directory_iterator(kRoot / folder)) {
      if (file.extension() == ".md") pages.insert(file);
    }
  }
  return pages;
}

TEST(Pages, NoLinkIsDead) {
  std::vector<std::string> dead;
  std::size_t links = 0;
  for (const fs::path& page : all_pages()) {
    for (const std::string& link : links_of(page)) {
      ++links;
      if (!fs::exists(target_of(page, link))) dead.push_back(page.string() + ": " + link);
    }
  }
  EXPECT_THAT(dead, IsEmpty());
  EXPECT_GT(links, all_pages().size());
}

TEST(Pages, EachIsReachedFromTheFirst) {
  std::vector<fs::path> reached{kRoot / "README.md"};
  for (std::size_t at = 0; at < reached.size(); ++at) {
    for (const std::string& link : links_of(fs::path(reached[at]))) {
      const fs::path target = target_of(reached[at], link);
      if (target.extension() == ".md" && std::ranges::count(reached, target) == 0) {
        reached.push_back(target);
      }
    }
  }
  EXPECT_THAT(reached, IsSupersetOf(all_pages()));
}

TEST(Pages, TheFirstIsReadInAMinute) {
  EXPECT_THAT(lines_of(kRoot / "README.md"), SizeIs(::testing::Le(130U)));
}

TEST(Pages, TellEveryKeyOfARecipeAsItIsDescribed) {
  std::string page;
  for (const std::string& line : lines_of(kRoot / "tools/lapwing/README.md")) page += line + "\n";
  for (const Operation& operation : operations()) {
    const auto heading = page.find("\n### " + std::string(operation.name) + "\n");
    ASSERT_NE(heading, std::string::npos) << operation.name;
    const auto next = page.find("\n### ", heading + 1);
    EXPECT_THAT(page.substr(heading, next - heading), HasSubstr("\n" + key_table(operation)))
        << "put in what `lapwing keys " << operation.name << "` prints";
  }
}

}  // namespace
}  // namespace lapwing
