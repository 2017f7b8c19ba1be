#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/recipe/recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;

Recipe parse_steps(const std::string& steps) {
  return parse_recipe(R"({"lapwing": 1, "mesh": "a.obj", "steps": [)" + steps + "]}", "/folder",
                      "test.json");
}

TEST(MeshSteps, ShortestFormsHaveTheDefaults) {
  const Recipe recipe = parse_steps(
      R"({"op": "remesh", "region": {"all": true}}, {"op": "decimate"}, {"op": "subdivide"},
         {"op": "fill_holes", "region": {"all": true}})");
  EXPECT_EQ(std::get<RemeshRequest>(recipe.steps[0]), (RemeshRequest{.region = {AllVertices{}}}));
  EXPECT_EQ(std::get<DecimateRequest>(recipe.steps[1]), DecimateRequest{});
  EXPECT_EQ(std::get<SubdivideRequest>(recipe.steps[2]), SubdivideRequest{});
  EXPECT_EQ(std::get<FillRequest>(recipe.steps[3]), FillRequest{});
}

TEST(MeshSteps, AreWrittenAndReadBack) {
  const Recipe recipe = parse_steps(
      R"({"op": "remesh", "region": {"vertices": [1, 2]}, "length": 0.5, "iterations": 3,
          "feature_degrees": 30}, {"op": "decimate", "share": 0.25},
         {"op": "subdivide", "times": 2, "smooth": true},
         {"op": "fill_holes", "region": {"vertices": [4]}, "shape": "flat", "largest": 9,
          "borders": true})");
  EXPECT_EQ(parse_recipe(to_json(recipe), "/folder", "test.json").steps, recipe.steps);
  EXPECT_EQ(std::get<FillRequest>(recipe.steps[3]).shape, FillShape::flat);
}

TEST(MeshSteps, NameTheKeyThatIsOutOfRange) {
  const auto refusal = [](const std::string& step) {
    return error_message<InputError>([&] { parse_steps(step); });
  };
  EXPECT_THAT(refusal(R"({"op": "decimate", "share": 0})"), HasSubstr("/steps/0/share: expected"));
  EXPECT_THAT(refusal(R"({"op": "subdivide", "times": 9})"), HasSubstr("/steps/0/times: expected"));
  EXPECT_THAT(refusal(R"({"op": "fill_holes"})"), HasSubstr("the key \"region\" is missing"));
  EXPECT_THAT(refusal(R"({"op": "remesh", "region": {"all": true}, "length": -1})"),
              HasSubstr("/steps/0/length: expected"));
}

}  // namespace
}  // namespace lapwing
