#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/recipe/recipe.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Recipe parse_coat(const std::string& text) {
  return parse_recipe(text, "/data", "coat.json");
}

// A recipe of one coat step; `keys` begins with a comma.
CoatStep coat_of(const std::string& keys) {
  const Recipe recipe = parse_coat(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "coat",
      "source_patch": {"all": true}, "target_patch": {"vertices": [1, 2, 3]}, "detail_size": 2)" +
                                   keys + "}]}");
  return std::get<CoatStep>(recipe.steps.at(0));
}

Recipe recipe_of(CoatStep step) {
  return {"target.ply", {std::move(step)}, "", "/data"};
}

// Every key away from its default.
CoatStep full_coat_step() {
  CoatStep step;
  step.source.mesh = "../meshes/lizard.ply";
  step.source.patch = {DiskInRegion{{{GeodesicDisk{Index{7}, 0.25}}}}};
  step.source.detail_size = 0.1 + 0.2;
  step.source.boundary_pairs = {{1, 10}, {2, 20}, {3, 30}, {4, 40}};
  step.source.inner_pairs = {{5, 50}, {6, 60}};
  step.source.sampling = {MappedSampling::linear, 1e-300};
  step.source.amplitude = -1.5;
  step.target_patch = {Box{{-1, -2, -3}, {4, 5, 6}}};
  CoatParameters& parameters = step.parameters;
  parameters.smooth_target = 1.0 / 3.0;
  parameters.weights = LaplacianWeights::uniform;
  parameters.domain = Domain::square;
  parameters.transition = Transition{0.0, Transition::Profile::linear};
  parameters.remesh = Remeshing::none;
  return step;
}

TEST(CoatStep, ReadsEveryKey) {
  CoatStep expected = full_coat_step();
  expected.source.patch = {AllVertices{}};
  expected.target_patch = {ListedVertices{{1, 2, 3}}};
  expected.source.detail_size = 2.0;
  expected.parameters.smooth_target = 0.5;
  expected.source.sampling.scale = 3.0;
  EXPECT_EQ(coat_of(R"(, "source": "../meshes/lizard.ply", "smooth_target": 0.5,
      "weights": "uniform", "domain": "square",
      "boundary_pairs": [[1, 10], [2, 20], [3, 30], [4, 40]], "inner_pairs": [[5, 50], [6, 60]],
      "sampling": "linear", "scale": 3, "amplitude": -1.5,
      "transition": {"width": 0, "profile": "linear"}, "remesh": "none")"),
            expected);
}

TEST(CoatStep, ShortestFormHasTheDefaults) {
  CoatStep expected;
  expected.source.patch = {AllVertices{}};
  expected.target_patch = {ListedVertices{{1, 2, 3}}};
  expected.source.detail_size = 2.0;
  const CoatStep step = coat_of("");
  EXPECT_EQ(step, expected);
  EXPECT_TRUE(step.source.mesh.empty());
  EXPECT_EQ(step.parameters.smooth_target, 0.0);
  EXPECT_EQ(step.parameters.weights, LaplacianWeights::cotangent);
  EXPECT_EQ(step.parameters.domain, Domain::disk);
  EXPECT_EQ(step.source.sampling.sampling, MappedSampling::one_ring);
  EXPECT_EQ(step.source.sampling.scale, std::nullopt);
  EXPECT_EQ(step.source.amplitude, 1.0);
  EXPECT_EQ(step.parameters.transition, std::nullopt);
  EXPECT_EQ(step.parameters.remesh, Remeshing::automatic);
}

TEST(CoatStep, DefaultsCanBeWrittenOut) {
  EXPECT_EQ(coat_of(R"(, "smooth_target": 0, "weights": "cotangent", "domain": "disk",
      "boundary_pairs": [], "inner_pairs": [], "sampling": "one_ring", "scale": "auto",
      "amplitude": 1, "remesh": "auto")"),
            coat_of(""));
}

TEST(CoatStep, TransitionIsSmoothUnlessToldOtherwise) {
  EXPECT_EQ(coat_of(R"(, "transition": {"width": 0.5})").parameters.transition,
            (Transition{0.5, Transition::Profile::smooth}));
  EXPECT_EQ(coat_of(R"(, "transition": {"width": 0.5, "profile": "smooth"})"),
            coat_of(R"(, "transition": {"width": 0.5})"));
}

TEST(CoatStep, KnowsWhereItWasWritten) {
  const CoatStep step = coat_of("");
  EXPECT_EQ(step.where, "coat.json: /steps/0");
  EXPECT_EQ(step.source.where, "coat.json: /steps/0");
  EXPECT_EQ(step.source.patch.where, "coat.json: /steps/0/source_patch");
  EXPECT_EQ(step.target_patch.where, "coat.json: /steps/0/target_patch");
}

TEST(CoatStep, IsReadBackAsItWasWritten) {
  for (const CoatStep& step : {full_coat_step(), coat_of("")}) {
    const std::string text = to_json(recipe_of(step));
    EXPECT_EQ(std::get<CoatStep>(parse_coat(text).steps.at(0)), step) << text;
    EXPECT_EQ(to_json(parse_coat(text)), text);
  }
}

TEST(CoatStep, StandsBesideADeform) {
  DeformRequest deform;
  deform.handles.push_back({{ListedVertices{{4}}}, SimilarityMove{}});
  const Recipe recipe{"a.obj", {full_coat_step(), deform, full_coat_step()}, "out.ply", "/data"};
  EXPECT_EQ(parse_coat(to_json(recipe)), recipe);
}

TEST(CoatStep, IsWrittenForReaders) {
  EXPECT_EQ(to_json(recipe_of(full_coat_step())), R"({
  "lapwing": 1,
  "mesh": "target.ply",
  "steps": [
    {
      "op": "coat",
      "source": "../meshes/lizard.ply",
      "source_patch": {"disk_in": {"disk": {"center": 7, "radius": 0.25}}},
      "target_patch": {"box": {"min": [-1, -2, -3], "max": [4, 5, 6]}},
      "detail_size": 0.30000000000000004,
      "smooth_target": 0.3333333333333333,
      "weights": "uniform",
      "domain": "square",
      "boundary_pairs": [[1, 10], [2, 20], [3, 30], [4, 40]],
      "inner_pairs": [[5, 50], [6, 60]],
      "sampling": "linear",
      "scale": 1e-300,
      "amplitude": -1.5,
      "transition": {"width": 0, "profile": "linear"},
      "remesh": "none"
    }
  ]
}
)");
}

TEST(CoatStep, WithoutASourceWritesNone) {
  const std::string text = to_json(recipe_of(coat_of("")));
  for (const char* key : {"\"source\":", "boundary_pairs", "inner_pairs", "transition"}) {
    EXPECT_THAT(text, Not(HasSubstr(key)));
  }
  EXPECT_THAT(text, HasSubstr(R"("scale": "auto")"));
}

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
