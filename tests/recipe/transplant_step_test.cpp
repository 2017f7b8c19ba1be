#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

Recipe parse_graft(const std::string& text) {
  return parse_recipe(text, "/data", "graft.json");
}

Recipe parse_step(const std::string& keys) {
  return parse_graft(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "transplant", )" + keys +
                     "}]}");
}

const std::string kTarget = R"("target_region": {"vertices": [1, 2, 3]})";

// A step of a part in a file; `keys` begins with a comma.
TransplantStep step_of(const std::string& keys) {
  const Recipe recipe = parse_step(R"("part": "wing.obj", )" + kTarget + keys);
  return std::get<TransplantStep>(recipe.steps.at(0));
}

std::string refusal(const std::string& keys) {
  return error_message<InputError>([&] { parse_step(keys); });
}

// Every key away from its default.
TransplantStep full_transplant_step() {
  TransplantStep step;
  step.part = "../parts/dragon.ply";
  step.part_region = {GeodesicDisk{Index{7}, 0.25}};
  step.loop = 2;
  step.place = Move{SimilarityMove{
      {1, 2, 3}, {{0, 0, 1}, 30.0}, Eigen::Vector3d::Constant(0.5), Eigen::Vector3d(4, 5, 6)}};
  step.snap = true;
  step.target_region = {Box{{-1, -2, -3}, {4, 5, 6}}};
  TransplantParameters& parameters = step.parameters;
  parameters.transition = Transition{0.1 + 0.2, Transition::Profile::linear};
  parameters.padding = 0.0;
  parameters.belt = 1.0 / 3.0;
  parameters.weights = LaplacianWeights::uniform;
  parameters.sampling = MappedSampling::one_ring;
  parameters.remesh = Remeshing::none;
  return step;
}

TEST(TransplantStep, ShortestFormHasTheDefaults) {
  TransplantStep expected;
  expected.part = "wing.obj";
  expected.target_region = {ListedVertices{{1, 2, 3}}};
  const TransplantStep step = step_of("");
  EXPECT_EQ(step, expected);
  EXPECT_EQ(std::get<LoopFit>(step.place), LoopFit{});
  EXPECT_EQ(step.parameters.sampling, MappedSampling::linear);
  EXPECT_EQ(step.where, "graft.json: /steps/0");
  EXPECT_EQ(step.target_region.where, "graft.json: /steps/0/target_region");
}

TEST(TransplantStep, ReadsEveryKey) {
  TransplantStep expected = full_transplant_step();
  expected.part_region = {AllVertices{}};
  expected.target_region = {ListedVertices{{1, 2, 3}}};
  expected.parameters.transition->width = 2.0;
  expected.parameters.belt = 0.5;
  const Recipe recipe = parse_step(
      R"("part": {"mesh": "../parts/dragon.ply", "region": {"all": true}}, "loop": 2,
         "place": {"translate": [1, 2, 3], "rotate": {"axis": [0, 0, 1], "degrees": 30},
                   "scale": 0.5, "pivot": [4, 5, 6]}, "snap": true,
         "transition": {"width": 2, "profile": "linear"}, "belt": {"padding": 0, "width": 0.5},
         "weights": "uniform", "sampling": "one_ring", "remesh": "none", )" +
      kTarget);
  EXPECT_EQ(std::get<TransplantStep>(recipe.steps[0]), expected);
}

TEST(TransplantStep, IsPlacedByItselfOrByAMove) {
  EXPECT_EQ(std::get<LoopFit>(step_of(R"(, "place": {"auto": {"rotate_degrees": 40, "scale": 2,
                                                "keep_size": true}})")
                                  .place),
            (LoopFit{40.0, 2.0, true}));
  EXPECT_EQ(step_of(R"(, "place": {"auto": {}})"), step_of(""));
  const TransplantStep by_matrix =
      step_of(R"(, "place": {"matrix": [2, 0, 0, 1, 0, 2, 0, 0, 0, 0, 2, 0]})");
  EXPECT_TRUE(std::holds_alternative<MatrixMove>(std::get<Move>(by_matrix.place)));
}

TEST(TransplantStep, TakesAPartOfTheMeshItself) {
  const Recipe recipe = parse_step(R"("part": {"region": {"all": true}}, )" + kTarget);
  EXPECT_TRUE(std::get<TransplantStep>(recipe.steps[0]).part.empty());
}

TEST(TransplantStep, IsReadBackAsItWasWritten) {
  TransplantStep fitted = step_of("");
  fitted.place = LoopFit{12.5, 0.5, true};
  TransplantStep own = full_transplant_step();
  own.part.clear();
  own.place = Move{MatrixMove{}};
  for (const TransplantStep& step : {full_transplant_step(), step_of(""), fitted, own}) {
    const std::string text = to_json({"host.ply", {step}, "", "/data"});
    EXPECT_EQ(std::get<TransplantStep>(parse_graft(text).steps.at(0)), step) << text;
    EXPECT_EQ(to_json(parse_graft(text)), text);
  }
}

TEST(TransplantStep, IsWrittenForReaders) {
  EXPECT_EQ(to_json({"host.ply", {full_transplant_step()}, "", "/data"}), R"({
  "lapwing": 1,
  "mesh": "host.ply",
  "steps": [
    {
      "op": "transplant",
      "part": {
        "mesh": "../parts/dragon.ply",
        "region": {"disk": {"center": 7, "radius": 0.25}}
      },
      "loop": 2,
      "place": {
        "translate": [1, 2, 3],
        "rotate": {"axis": [0, 0, 1], "degrees": 30},
        "scale": 0.5,
        "pivot": [4, 5, 6]
      },
      "snap": true,
      "target_region": {"box": {"min": [-1, -2, -3], "max": [4, 5, 6]}},
      "transition": {"width": 0.30000000000000004, "profile": "linear"},
      "belt": {"padding": 0, "width": 0.3333333333333333},
      "weights": "uniform",
      "sampling": "one_ring",
      "remesh": "none"
    }
  ]
}
)");
}

TEST(TransplantStep, NamesThePlaceOfWhatIsWrong) {
  EXPECT_THAT(refusal(R"("part": "wing.obj")"), HasSubstr("target_region"));
  EXPECT_THAT(refusal(kTarget), HasSubstr("part"));
  EXPECT_THAT(refusal(R"("part": {}, )" + kTarget), AllOf(HasSubstr("/part"), HasSubstr("region")));
  EXPECT_THAT(refusal(R"("part": 3, )" + kTarget), HasSubstr("/part"));
  const auto with = [&](const std::string& keys) {
    return refusal(R"("part": "wing.obj", )" + keys + ", " + kTarget);
  };
  EXPECT_THAT(with(R"("loop": -1)"), HasSubstr("/loop"));
  EXPECT_THAT(with(R"("place": {"auto": {"rotate": 3}})"),
              AllOf(HasSubstr("/place/auto"), HasSubstr("rotate_degrees")));
  EXPECT_THAT(with(R"("place": {"auto": {"scale": 0}})"), HasSubstr("/place/auto/scale"));
  EXPECT_THAT(with(R"("snap": true)"), AllOf(HasSubstr("/snap"), HasSubstr("move")));
  EXPECT_THAT(with(R"("belt": {"width": 0})"), HasSubstr("/belt/width"));
  EXPECT_THAT(with(R"("belt": {"fraction": 0.1})"), HasSubstr("/belt"));
  EXPECT_THAT(with(R"("transition": {"width": -1})"), HasSubstr("/transition/width"));
  EXPECT_THAT(with(R"("remesh": "yes")"), HasSubstr("/remesh"));
}

}  // namespace
}  // namespace lapwing
