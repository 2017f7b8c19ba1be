#include "lapwing/recipe/recipe_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/temporary_folder.h"
#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kHandle = R"("roi": {"all": true}, "belt": {"fraction": 0.1},
  "handles": [{"region": {"vertices": [1]}, "move": {"translate": [0, 0, 1]}}])";

Recipe recipe_with(const std::string& step, const fs::path& folder,
                   const std::string& save = "out.obj") {
  return parse_recipe(R"({"lapwing": 1, "mesh": "in.obj", "save": ")" + save +
                          R"(", "steps": [{"op": "deform", )" + kHandle + step + "}]}",
                      folder, "test");
}

TEST(RecipeFiles, AreAllThatItReadsAndWrites) {
  const RecipeFiles files =
      files_of(recipe_with(R"(, "carry": ["hat.obj", {"file": "pins.csv", "save": "x/pins.csv"}])",
                           "base", "result/out.obj"));
  EXPECT_THAT(files.read, ElementsAre("base/in.obj", "base/hat.obj", "base/pins.csv"));
  EXPECT_THAT(files.written,
              ElementsAre("base/result/out.obj", "base/result/hat-carried.obj", "base/x/pins.csv"));
}

TEST(RecipeFiles, BesideAResultElsewhere) {
  const RecipeFiles files =
      files_of(recipe_with(R"(, "carry": ["hat.obj"])", "base"), "there/a.ply");
  EXPECT_THAT(files.written, ElementsAre("there/a.ply", "there/hat-carried.obj"));
}

TEST(RecipeFiles, StayInTheirFolderWhereTheyMust) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "box");
  fs::create_symlink("../outside.obj", folder / "box/link.obj");
  const auto refusal = [&](const Recipe& recipe) {
    return error_message<InputError>([&] { require_inside(recipe, folder / "box"); });
  };
  const fs::path box = folder / "box";
  EXPECT_EQ(refusal(recipe_with("", box)), "");
  EXPECT_THAT(refusal(recipe_with("", box, "../out.obj")), HasSubstr("the recipe writes "));
  EXPECT_THAT(refusal(recipe_with("", box, "/tmp/out.obj")), HasSubstr("/tmp/out.obj"));
  EXPECT_THAT(refusal(recipe_with("", box, "link.obj")), HasSubstr("which is outside "));
  EXPECT_THAT(refusal(recipe_with(R"(, "carry": ["../hat.obj"])", box)),
              HasSubstr("the recipe reads "));
  EXPECT_THAT(refusal(recipe_with("", folder.path())), HasSubstr("in.obj"));
}

}  // namespace
}  // namespace lapwing
