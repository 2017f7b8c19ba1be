#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/recipe/recipe.h"

namespace lapwing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Recipe parse_mix(const std::string& text) {
  return parse_recipe(text, "/data", "mix.json");
}

// A recipe of one mix step; `keys` begins with a comma.
MixStep mix_of(const std::string& keys) {
  const Recipe recipe = parse_mix(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "mix",
      "target_patch": {"vertices": [1, 2, 3]},
      "sources": [{"mesh": "b.obj", "patch": {"all": true}, "detail_size": 2},
                  {"patch": {"vertices": [4, 5, 6]}, "detail_size": 3}])" +
                                  keys + "}]}");
  return std::get<MixStep>(recipe.steps.at(0));
}

const std::string kByDistance = R"(, "weight": {"distance_to": {"vertices": [7]}, "width": 0.5})";

Recipe recipe_of(MixStep step) {
  return {"target.ply", {std::move(step)}, "", "/data"};
}

// The two sources of `mix_of`, all else as it is by itself.
MixStep short_step() {
  MixStep step;
  step.target_patch = {ListedVertices{{1, 2, 3}}};
  step.sources[0].mesh = "b.obj";
  step.sources[0].patch = {AllVertices{}};
  step.sources[0].detail_size = 2.0;
  step.sources[1].patch = {ListedVertices{{4, 5, 6}}};
  step.sources[1].detail_size = 3.0;
  step.weight.form = DistanceRamp{{ListedVertices{{7}}}, 0.5};
  return step;
}

// Every key away from its default.
MixStep full_mix_step() {
  MixStep step = short_step();
  FileSource& first = step.sources[0];
  first.boundary_pairs = {{1, 10}, {2, 20}, {3, 30}, {4, 40}};
  first.inner_pairs = {{5, 50}, {6, 60}};
  first.sampling = {MappedSampling::linear, 0.1 + 0.2};
  first.amplitude = -1.5;
  step.transfer = TransferMode::shape;
  step.weight = {DomainRamp{0.75, 0.25}, Transition::Profile::linear};
  step.handles.push_back(
      {{ListedVertices{{2}}}, SimilarityMove{{0, 0, 1}, {}, Eigen::Vector3d::Constant(2.0), {}}});
  step.parameters.smooth_target = 1.0 / 3.0;
  step.parameters.weights = LaplacianWeights::uniform;
  step.parameters.domain = Domain::square;
  step.parameters.transition = Transition{0.0, Transition::Profile::linear};
  step.parameters.remesh = Remeshing::none;
  return step;
}

TEST(MixStep, ShortestFormHasTheDefaults) {
  const MixStep step = mix_of(kByDistance);
  EXPECT_EQ(step, short_step());
  EXPECT_TRUE(step.sources[1].mesh.empty());
  EXPECT_EQ(step.transfer, TransferMode::coating);
  EXPECT_EQ(step.weight.profile, Transition::Profile::smooth);
  EXPECT_EQ(step.parameters, CoatParameters{});
  EXPECT_TRUE(step.handles.empty());
}

TEST(MixStep, ReadsEveryFormOfTheWeight) {
  EXPECT_EQ(mix_of(R"(, "domain": "square", "weight": {"domain_v": [0.25, 0.75]})").weight,
            (MixWeight{DomainRamp{0.25, 0.75}}));
  EXPECT_EQ(mix_of(kByDistance + R"(, "profile": "linear")").weight,
            (MixWeight{DistanceRamp{{ListedVertices{{7}}}, 0.5}, Transition::Profile::linear}));
  EXPECT_EQ(mix_of(R"(, "weight": {"distance_to": {"all": true}, "width": 0})").weight,
            (MixWeight{DistanceRamp{{AllVertices{}}, 0.0}}));
  EXPECT_EQ(mix_of(R"(, "weight": {"field": [0, 0.5, 1]})").weight,
            (MixWeight{PaintedWeight{{0.0, 0.5, 1.0}}}));
}

TEST(MixStep, IsReadBackAsItWasWritten) {
  MixStep painted = short_step();
  painted.weight = {PaintedWeight{{0.0, 0.1, 1.0}}};
  for (const MixStep& step : {full_mix_step(), short_step(), painted}) {
    const std::string text = to_json(recipe_of(step));
    EXPECT_EQ(std::get<MixStep>(parse_mix(text).steps.at(0)), step) << text;
    EXPECT_EQ(to_json(parse_mix(text)), text);
  }
}

TEST(MixStep, KnowsWhereItWasWritten) {
  const MixStep step = mix_of(kByDistance);
  EXPECT_EQ(step.where, "mix.json: /steps/0");
  EXPECT_EQ(step.sources[1].where, "mix.json: /steps/0/sources/1");
  EXPECT_EQ(step.sources[1].patch.where, "mix.json: /steps/0/sources/1/patch");
  EXPECT_EQ(std::get<DistanceRamp>(step.weight.form).region.where,
            "mix.json: /steps/0/weight/distance_to");
}

TEST(MixStep, IsWrittenForReaders) {
  EXPECT_EQ(to_json(recipe_of(full_mix_step())), R"({
  "lapwing": 1,
  "mesh": "target.ply",
  "steps": [
    {
      "op": "mix",
      "target_patch": {"vertices": [1, 2, 3]},
      "sources": [
        {
          "mesh": "b.obj",
          "patch": {"all": true},
          "detail_size": 2,
          "boundary_pairs": [[1, 10], [2, 20], [3, 30], [4, 40]],
          "inner_pairs": [[5, 50], [6, 60]],
          "sampling": "linear",
          "scale": 0.30000000000000004,
          "amplitude": -1.5
        },
        {
          "patch": {"vertices": [4, 5, 6]},
          "detail_size": 3,
          "sampling": "one_ring",
          "scale": "auto",
          "amplitude": 1
        }
      ],
      "take": "shape",
      "weight": {"domain_v": [0.75, 0.25]},
      "profile": "linear",
      "handles": [{"region": {"vertices": [2]}, "move": {"translate": [0, 0, 1], "scale": 2}}],
      "smooth_target": 0.3333333333333333,
      "weights": "uniform",
      "domain": "square",
      "transition": {"width": 0, "profile": "linear"},
      "remesh": "none"
    }
  ]
}
)");
}

TEST(MixStep, WritesNoProfileOfAPaintedField) {
  MixStep step = short_step();
  step.weight = {PaintedWeight{{1.0}}};
  EXPECT_THAT(to_json(recipe_of(step)), Not(HasSubstr("profile")));
}

}  // namespace
}  // namespace lapwing
