#include "lapwing/recipe/recipe.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

// The example of the documentation.
constexpr const char* kExample = R"({ "lapwing": 1, "mesh": "armadillo.off",
  "steps": [ { "op": "deform",
      "roi":  {"all": true},
      "belt": {"vertices": [0, 1, 2]},
      "handles": [ { "region": {"vertices": [7, 8]},
                     "move": {"translate": [0, 10, 0],
                              "rotate": {"axis": [0, 0, 1], "degrees": 30},
                              "scale": 1.5, "pivot": [0, 0, 0]} } ],
      "weights": "cotangent", "constraint_weight": 2.0, "hard": true, "settle": false } ],
  "save": "out.obj" })";

Recipe parse(const std::string& text) {
  return parse_recipe(text, "/data", "bend.json");
}

const DeformRequest& first_step(const Recipe& recipe) {
  return std::get<DeformRequest>(recipe.steps[0]);
}

// A recipe of one step with these regions.
std::string with_regions(const std::string& roi, const std::string& belt) {
  return R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform", "roi": )" + roi +
         R"(, "belt": )" + belt +
         R"(, "handles": [{"region": {"vertices": [1]}, "move": {"translate": [0, 0, 1]}}]}]})";
}
RegionSpec roi_of(const std::string& roi) {
  return first_step(parse(with_regions(roi, R"({"fraction": 0.1})"))).roi;
}

TEST(Recipe, ReadsTheExample) {
  const Recipe recipe = parse(kExample);
  EXPECT_EQ(recipe.mesh_path(), "/data/armadillo.off");
  EXPECT_EQ(recipe.save_path(), "/data/out.obj");
  const DeformRequest& step = first_step(recipe);
  EXPECT_EQ(step.roi, RegionSpec{AllVertices{}});
  EXPECT_EQ(std::get<RegionSpec>(step.belt), (RegionSpec{ListedVertices{{0, 1, 2}}}));
  ASSERT_EQ(step.handles.size(), 1U);
  EXPECT_EQ(step.handles[0].region, (RegionSpec{ListedVertices{{7, 8}}}));
  EXPECT_EQ(step.handles[0].move, Move(SimilarityMove{{0, 10, 0},
                                                      {Vector3d::UnitZ(), 30.0},
                                                      Vector3d::Constant(1.5),
                                                      Vector3d(Vector3d::Zero())}));
  EXPECT_EQ(step.parameters.weights, LaplacianWeights::cotangent);
  EXPECT_EQ(step.parameters.constraint_weight, 2.0);
  EXPECT_TRUE(step.parameters.hard);
  EXPECT_FALSE(step.parameters.settle.has_value());
}

TEST(Recipe, SettlesByDefaultOrAsTold) {
  const auto settle_of = [](const std::string& keys) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "weights": "cotangent",
        "handles": [{"region": {"vertices": [1]}, "move": {}}])" +
                            keys + "}]}"))
        .parameters.settle;
  };
  SettleOptions expected;
  EXPECT_EQ(settle_of(""), expected);
  EXPECT_EQ(settle_of(R"(, "settle": true)"), expected);
  EXPECT_EQ(settle_of(R"(, "settle": false)"), std::nullopt);
  expected = {1e-6, 7};
  const auto told = settle_of(R"(, "settle": {"tolerance": 1e-6, "max_iterations": 7})");
  EXPECT_EQ(told, expected);
}

TEST(Recipe, CommitsOnTheWayOnlyAsTold) {
  const auto commit_every = [](const std::string& keys) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}])" +
                            keys + "}]}"))
        .parameters.commit_every;
  };
  EXPECT_EQ(commit_every(""), std::nullopt);
  EXPECT_EQ(commit_every(R"(, "commit_every": 130)"), 130.0);
  EXPECT_EQ(commit_every(R"(, "commit_every": 180)"), 180.0);
}

TEST(Recipe, DetailLengthAndResponseAreAsTold) {
  const auto parameters = [](const std::string& keys) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}])" +
                            keys + "}]}"))
        .parameters;
  };
  EXPECT_EQ(parameters(R"(, "detail_length": 0.2)").detail_length, 0.2);
  EXPECT_EQ(parameters(R"(, "response": "rsi")").response, LinearResponse::rsi);
  EXPECT_EQ(parameters(R"(, "response": "tangent")").response, LinearResponse::tangent);
}

TEST(Recipe, DefaultsAreThoseOfTheEngine) {
  const Recipe recipe = parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
      "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}]}]})");
  const DeformRequest& step = first_step(recipe);
  EXPECT_EQ(step.belt, BeltSpec(BoundaryAnchors{0.1, ""}));
  EXPECT_EQ(step.handles[0].move, Move(SimilarityMove{}));
  const DeformOptions options;
  EXPECT_EQ(step.parameters.weights, options.weights);
  EXPECT_EQ(step.parameters.detail_length, options.detail_length);
  EXPECT_EQ(step.parameters.response, options.response);
  EXPECT_EQ(step.parameters.constraint_weight, options.constraint_weight);
  EXPECT_EQ(step.parameters.hard, options.hard);
  EXPECT_EQ(step.parameters.settle, options.settle);
  EXPECT_TRUE(recipe.save_path().empty());
}

TEST(Recipe, ReadsEveryFormOfRegion) {
  EXPECT_EQ(roi_of(R"({"disk": {"center": 4, "radius": 0.5}})"),
            (RegionSpec{GeodesicDisk{Index{4}, 0.5}}));
  EXPECT_EQ(roi_of(R"({"disk": {"near": [1, 2, 3], "radius": 2}})"),
            (RegionSpec{GeodesicDisk{Vector3d(1, 2, 3), 2.0}}));
  EXPECT_EQ(roi_of(R"({"box": {"min": [0, 0, 0], "max": [1, 2, 3]}})"),
            (RegionSpec{Box{{0, 0, 0}, {1, 2, 3}}}));
  EXPECT_EQ(roi_of(R"({"loop": [3, 4, 5], "inside": 9})"), (RegionSpec{LoopRegion{{3, 4, 5}, 9}}));
  EXPECT_EQ(roi_of(R"({"disk_in": {"vertices": [1, 2]}})"),
            (RegionSpec{DiskInRegion{{{ListedVertices{{1, 2}}}}}}));
  EXPECT_EQ(
      roi_of(R"({"union": [{"vertices": [1]}, {"minus": [{"all": true},
                                                               {"vertices": [2]}]}]})"),
      (RegionSpec{UnionRegion{
          {{ListedVertices{{1}}}, {DifferenceRegion{{{AllVertices{}}, {ListedVertices{{2}}}}}}}}}));
}

TEST(Recipe, ReadsEveryFormOfMirror) {
  const auto mirror_of = [](const std::string& mirror) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}], "mirror": )" +
                            mirror + "}]}"))
        .mirror;
  };
  EXPECT_EQ(mirror_of(R"("auto")"), MirrorSpec{AutomaticMirror{}});
  EXPECT_EQ(mirror_of(R"({"plane": "y"})"), (MirrorSpec{MirrorPlane{{0, 0, 0}, {0, 1, 0}}}));
  EXPECT_EQ(mirror_of(R"({"point": [1, 2, 3], "normal": [0, 2, 0.5]})"),
            (MirrorSpec{MirrorPlane{{1, 2, 3}, {0, 2, 0.5}}}));
  EXPECT_EQ(mirror_of(R"("auto")")->where, "bend.json: /steps/0/mirror");
}

TEST(Recipe, ReadsHowFirmlyAHandleHolds) {
  const auto falloff_of = [](const std::string& keys) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {})" +
                            keys + "}]}]}"))
        .handles[0]
        .falloff;
  };
  EXPECT_EQ(falloff_of(""), Falloff{});
  EXPECT_EQ(falloff_of(R"(, "falloff": {"width": 2})"), (Falloff{{}, Transition{2.0}}));
  EXPECT_EQ(falloff_of(R"(, "weight": 3, "falloff": {"width": 2, "profile": "linear"})"),
            (Falloff{3.0, Transition{2.0, Transition::Profile::linear}}));
  EXPECT_EQ(falloff_of(R"(, "weight": {"field": [0, 0.5, 1]})"),
            (Falloff{{}, {}, {0.0, 0.5, 1.0}}));
}

TEST(Recipe, ReadsHowStiffAPartIs) {
  const auto stiffness = first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [
      {"op": "deform", "roi": {"all": true}, "handles": [{"region": {"vertices": [1]}, "move": {}}],
       "stiffness": [{"region": {"vertices": [1]}, "factor": 3},
                     {"region": {"vertices": [2]}, "factor": "rigid"},
                     {"region": {"all": true}, "factor": {"field": [0.01, "rigid", 1]}}]}]})"))
                             .stiffness;
  const std::vector<StiffnessSpec> expected{
      {{ListedVertices{{1}}}, 3.0},
      {{ListedVertices{{2}}}, kRigidStiffness},
      {{AllVertices{}}, kRigidStiffness, {0.01, kRigidStiffness, 1.0}}};
  EXPECT_EQ(stiffness, expected);
  EXPECT_EQ(stiffness[1].region.where, "bend.json: /steps/0/stiffness/1/region");
}

TEST(Recipe, RegionsKnowWhereTheyWereWritten) {
  const Recipe recipe = parse(
      with_regions(R"({"union": [{"all": true}, {"vertices": [2]}]})", R"({"fraction": 0.2})"));
  const DeformRequest& step = first_step(recipe);
  EXPECT_EQ(step.roi.where, "bend.json: /steps/0/roi");
  EXPECT_EQ(std::get<UnionRegion>(step.roi.form).parts[1].where, "bend.json: /steps/0/roi/union/1");
  EXPECT_EQ(std::get<BoundaryAnchors>(step.belt).where, "bend.json: /steps/0/belt");
  EXPECT_EQ(step.handles[0].region.where, "bend.json: /steps/0/handles/0/region");
}

TEST(Recipe, MatrixOfTwelveOrSixteenNumbersIsRowByRow) {
  const auto move_of = [](const std::string& numbers) {
    return first_step(parse(R"({"lapwing": 1, "mesh": "a.obj", "steps": [{"op": "deform",
        "roi": {"all": true}, "handles": [{"region": {"vertices": [1]},
        "move": {"matrix": [)" +
                            numbers + "]}}]}]}"))
        .handles[0]
        .move;
  };
  MatrixMove expected;
  expected.matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12;
  EXPECT_EQ(move_of("1,2,3,4,5,6,7,8,9,10,11,12"), Move(expected));
  EXPECT_EQ(move_of("1,2,3,4,5,6,7,8,9,10,11,12,0,0,0,1"), Move(expected));
}

// A recipe that uses every form with numbers that are hard to print.
Recipe full_recipe() {
  DeformRequest step;
  std::vector<Index> many(300);
  for (Index k = 0; k < 300; ++k) many[k] = 7 * k;
  const RegionSpec disk{GeodesicDisk{Vector3d(0.1, -1e-300, 1.0 / 3.0), 1e22}};
  const RegionSpec box{Box{{-1, -2, -3}, {4, 5, 6}}};
  const RegionSpec loop{LoopRegion{{5, 6, 7, 8}, 1}};
  step.roi = {
      UnionRegion{{disk, {DiskInRegion{{box}}}, {DifferenceRegion{{{AllVertices{}}, loop}}}}}};
  step.belt = BoundaryAnchors{0.15, ""};
  step.handles.push_back({{ListedVertices{many}}, SimilarityMove{}});
  step.handles.push_back(
      {{GeodesicDisk{Index{3}, 0.25}},
       SimilarityMove{
           {1, 2.5, -3}, {Vector3d(1, 1, 0), -12.5}, Vector3d(0.3, 1, 2), Vector3d(9, 8, 7)}});
  MatrixMove matrix;
  matrix.matrix(0, 3) = 0.1 + 0.2;
  step.handles.push_back({{ListedVertices{}}, matrix});
  step.handles[0].falloff = {0.1, Transition{1.0 / 3.0}};
  step.handles[1].falloff = {2.5, Transition{2.0, Transition::Profile::linear}};
  step.handles[2].falloff.field = {0.0, 1.0 / 3.0, 1.0};
  step.stiffness = {
      {box, 0.1}, {loop}, {disk, kRigidStiffness, {kRigidStiffness, 1.0 / 3.0, 100.0}}};
  step.mirror = MirrorSpec{MirrorPlane{{0.1, 1e-300, 3}, {1.0 / 3.0, 0, -2}}};
  step.parameters.weights = LaplacianWeights::cotangent;
  step.parameters.constraint_weight = 10.0;
  step.parameters.hard = true;
  step.parameters.commit_every = 0.1;
  DeformRequest other;
  other.belt = RegionSpec{ListedVertices{{1, 2}}};
  other.handles.push_back({{ListedVertices{{4}}}, SimilarityMove{}});
  other.mirror = MirrorSpec{AutomaticMirror{}};
  return {"meshes/a \"b\".obj", {step, other}, "out.ply", "/data", "smile"};
}

TEST(Recipe, ReadsBackWhatItWrites) {
  const Recipe recipe = full_recipe();
  const std::string text = to_json(recipe);
  EXPECT_EQ(parse(text), recipe);
  EXPECT_EQ(to_json(parse(text)), text);
}

TEST(Recipe, IsWrittenForReaders) {
  Recipe recipe = parse(kExample);
  EXPECT_EQ(to_json(recipe), R"({
  "lapwing": 1,
  "mesh": "armadillo.off",
  "steps": [
    {
      "op": "deform",
      "roi": {"all": true},
      "belt": {"vertices": [0, 1, 2]},
      "handles": [
        {
          "region": {"vertices": [7, 8]},
          "move": {
            "translate": [0, 10, 0],
            "rotate": {"axis": [0, 0, 1], "degrees": 30},
            "scale": 1.5,
            "pivot": [0, 0, 0]
          }
        }
      ],
      "weights": "cotangent",
      "detail_length": 0.077,
      "response": "tangent",
      "constraint_weight": 2,
      "hard": true,
      "settle": false,
      "loose": "carry",
      "seams": "join"
    }
  ],
  "save": "out.obj"
}
)");
}

TEST(Recipe, LongListsFillTheirLines) {
  const std::string text = to_json(full_recipe());
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    EXPECT_LE(end - begin, 100U);
  }
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 100);
}

TEST(Recipe, FileGivesTheBaseDirectory) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "lapwing_recipe_test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "bend.json") << kExample;
  EXPECT_EQ(read_recipe(folder / "bend.json").mesh_path(), folder / "armadillo.off");
  std::filesystem::remove_all(folder);
}

TEST(Recipe, FileThatCannotBeReadIsNamed) {
  EXPECT_THAT(error_message<IoError>([] { read_recipe("/nowhere/bend.json"); }),
              HasSubstr("cannot read /nowhere/bend.json: No such file"));
  EXPECT_THAT(error_message<IoError>([] { read_recipe(::testing::TempDir()); }),
              HasSubstr("not a regular file"));
}

TEST(Recipe, NameThatIsNotUtf8CannotBeWritten) {
  Recipe recipe;
  recipe.mesh = "caf\xe9.obj";
  EXPECT_THAT(error_message<InputError>([&] { to_json(recipe); }), HasSubstr("is not UTF-8"));
}

}  // namespace
}  // namespace lapwing
