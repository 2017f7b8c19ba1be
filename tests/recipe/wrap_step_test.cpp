#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/recipe/recipe.h"
#include "lapwing/recipe/recipe_files.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Recipe wrap_recipe(const std::string& step) {
  return parse_recipe(R"({"lapwing": 1, "mesh": "a.ply", "steps": [)" + step + "]}", "/folder",
                      "test.json");
}
WrapStep wrap_step(const std::string& keys) {
  return std::get<WrapStep>(wrap_recipe(R"({"op": "wrap", "scan": "s.ply")" + keys + "}").steps[0]);
}

TEST(WrapStep, HasRowsOrFilesOfLandmarks) {
  EXPECT_EQ(wrap_step(""), WrapStep{.scan = "s.ply"});
  EXPECT_TRUE(wrap_step(R"(, "aligned": true)").aligned);
  EXPECT_TRUE(wrap_step(R"(, "hard": true)").hard);
  EXPECT_TRUE(wrap_step(R"(, "detail": true)").detail);
  EXPECT_EQ(wrap_step(R"(, "mirror": {"plane": "y"})").mirror,
            MirrorSpec{MirrorPlane{.normal = Eigen::Vector3d::UnitY()}});
  EXPECT_EQ(wrap_step(R"(, "landmarks": "l.csv")").landmarks, LandmarkSpec{.file = "l.csv"});
  EXPECT_EQ(wrap_step(R"(, "landmarks": {"template": "t.fcsv", "scan": "s.fcsv"})").landmarks,
            (LandmarkSpec{.file = "t.fcsv", .scan_file = "s.fcsv"}));
  EXPECT_THAT(
      wrap_step(R"(, "landmarks": [[1, 2, 3, 4], {"vertex": 5, "scan_vertex": 6}])").landmarks.rows,
      ElementsAre(Landmark{Index{1}, Eigen::Vector3d(2, 3, 4)}, Landmark{Index{5}, Index{6}}));
}

TEST(WrapStep, IsWrittenAndReadBack) {
  for (
      const char* landmarks :
      {R"("l.csv")", R"({"template": "t.fcsv", "scan": "s.fcsv"})",
       R"([[1, 2, 3, 4], [0, 0, 1, 2, 3, 4, 0.5], {"point": [1, 2, 3], "scan_vertex": 6, "label": "nose"}])"}) {
    const Recipe recipe = wrap_recipe(R"({"op": "wrap", "scan": "s.ply", "aligned": true,
      "hard": true, "mirror": {"plane": "y"}, "detail": true, "landmarks": )" +
                                      std::string(landmarks) + "}");
    EXPECT_EQ(parse_recipe(to_json(recipe), "/folder", "test.json").steps, recipe.steps);
  }
}

TEST(WrapStep, NamesTheKeyThatIsWrong) {
  const auto refusal = [](const std::string& step) {
    return error_message<InputError>([&] { wrap_recipe(step); });
  };
  EXPECT_THAT(refusal(R"({"op": "wrap"})"), HasSubstr("the key \"scan\" is missing"));
  EXPECT_THAT(refusal(R"({"op": "wrap", "scan": "s.ply", "landmarks": {"template": "t.fcsv"}})"),
              HasSubstr("the key \"scan\" is missing"));
  EXPECT_THAT(refusal(R"({"op": "wrap", "scan": "s.ply", "landmarks": [[1, 2, 3]]})"),
              HasSubstr("/steps/0/landmarks/0: expected 4 numbers"));
}

TEST(WrapStep, ReadsTheScanAndTheLandmarks) {
  EXPECT_THAT(files_of(wrap_recipe(R"({"op": "wrap", "scan": "s.ply",
                "landmarks": {"template": "t.fcsv", "scan": "s.fcsv"}})"))
                  .read,
              ElementsAre("/folder/a.ply", "/folder/s.ply", "/folder/t.fcsv", "/folder/s.fcsv"));
}

}  // namespace
}  // namespace lapwing
