#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Recipe parse_peel(const std::string& keys) {
  return parse_recipe(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "peel")" + keys + "}]}",
                      "/data", "smooth.json");
}

PeelRequest peel_step_of(const std::string& keys) {
  return std::get<PeelRequest>(parse_peel(keys).steps.at(0));
}

TEST(PeelStep, ShortestFormHasTheDefaults) {
  const PeelRequest step = peel_step_of(R"(, "region": {"all": true}, "detail_size": 0.5)");
  EXPECT_EQ(step, (PeelRequest{{AllVertices{}}, 0.5}));
  EXPECT_EQ(step.where, "smooth.json: /steps/0");
  EXPECT_EQ(step.region.where, "smooth.json: /steps/0/region");
}

TEST(PeelStep, IsWrittenForReadersAndReadBack) {
  const Recipe recipe =
      parse_peel(R"(, "region": {"vertices": [1, 2]}, "detail_size": 2, "weights": "uniform")");
  const std::string text = to_json(recipe);
  EXPECT_EQ(text, R"({
  "lapwing": 1,
  "mesh": "a.obj",
  "steps": [
    {"op": "peel", "region": {"vertices": [1, 2]}, "detail_size": 2, "weights": "uniform"}
  ]
}
)");
  EXPECT_EQ(parse_recipe(text, "/data", "smooth.json"), recipe);
}

TEST(PeelStep, RefusesWhatItCannotDo) {
  const auto refusal = [](const std::string& keys) {
    return error_message<InputError>([&] { parse_peel(keys); });
  };
  EXPECT_THAT(refusal(R"(, "region": {"all": true}, "detail_size": 0)"),
              AllOf(HasSubstr("/steps/0/detail_size"), HasSubstr("a number above 0")));
  EXPECT_THAT(refusal(R"(, "detail_size": 1)"), HasSubstr("region"));
  EXPECT_THAT(refusal(R"(, "region": {"all": true}, "detail_size": 1, "coating": "height")"),
              HasSubstr("coating"));
}

}  // namespace
}  // namespace lapwing
