// Turns of handles past 180 degrees: what a surface makes of them, and what is told about it.
#include "lapwing/deform/modifiers/winding.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "run/recipe_runs.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr Index kAround = 60;

class Winding : public test::RecipeRuns {
 protected:
  Winding() : RecipeRuns("cylinder.ply") {}

  void SetUp() override {
    write_mesh(test::rippled_cylinder(kAround), folder_.path() / "cylinder.ply");
  }

  // The cylinder's upper end turned about its axis.
  static std::string twist(double degrees, const std::string& keys = {}) {
    return R"({"op": "deform", "roi": {"all": true},
        "belt": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.59]}},
        "handles": [{"region": {"box": {"min": [-1, -1, 5.41], "max": [1, 1, 7]}},
          "move": {"rotate": {"axis": [0, 0, 1], "degrees": )" +
           std::to_string(degrees) + "}}}]" + keys + "}";
  }
};

const char* const kCommits = R"(, "commit_every": 130)";
const char* const kResist = R"(, "commit_every": 180, "detail_length": 0.045)";

double angle(const Vector3d& p) {
  return std::atan2(p.y(), p.x()) * 180.0 / std::numbers::pi;
}

// By how many degrees vertex 0 of each circle has turned, followed from circle to circle.
std::vector<double> turns_of_circles(const RunResult& result) {
  std::vector<double> turns;
  double last = 0.0;
  for (Index v = 0; v < result.mesh.vertex_count(); v += kAround) {
    const double turn = angle(result.mesh.positions[v]) - angle(result.original[v]);
    last += std::remainder(turn - last, 360.0);
    turns.push_back(last);
  }
  return turns;
}

double detail_error_between(const RunResult& from, const RunResult& to) {
  const Topology& topology = from.mesh.topology();
  const auto weights = laplacian_weights(topology, from.mesh.positions, LaplacianWeights::uniform);
  std::vector<Index> free;
  for (Index v = 0; v < from.mesh.vertex_count(); ++v) {
    if (from.original[v].z() > 0.59 && from.original[v].z() < 5.41) free.push_back(v);
  }
  return detail_error(free, topology, weights, from.mesh.positions, to.mesh.positions);
}

TEST_F(Winding, TwistOf260DegreesInTwoCommitsOf130IsKept) {
  const auto half = run(twist(130, kCommits));
  const auto whole = run(twist(260, kCommits));
  const std::vector<double> turns = turns_of_circles(*whole);
  for (std::size_t k = 1; k < turns.size(); ++k) EXPECT_GT(turns[k], turns[k - 1] - 0.1);
  EXPECT_NEAR(turns.front(), 0.0, 1.0);
  EXPECT_NEAR(turns[turns.size() / 2], 130.0, 5.0);
  EXPECT_NEAR(turns.back(), 260.0, 1.0);
  EXPECT_LT(half->report.steps[0].deform->certificate.detail_error, 0.065);
  EXPECT_LT(detail_error_between(*half, *whole), 0.12);

  const StepReport& step = whole->report.steps[0];
  EXPECT_EQ(step.deform->commits, 2U);
  EXPECT_EQ(step.deform->turn_degrees, 260.0);
  ASSERT_TRUE(step.deform->winding_degrees.has_value());
  EXPECT_NEAR(*step.deform->winding_degrees, 260.0, 1.0);
  EXPECT_TRUE(step.deform->certificate.settled);
  EXPECT_THAT(whole->report.warnings, IsEmpty());
}

TEST_F(Winding, LargeTurnsAreMadeInPartsByThemselves) {
  for (const double degrees : {260.0, 300.0, 360.0, 720.0}) {
    const auto wound = run(twist(degrees));
    EXPECT_NEAR(turns_of_circles(*wound).back(), degrees, 1.0);
    const StepReport& step = wound->report.steps[0];
    EXPECT_EQ(step.deform->commits, static_cast<std::size_t>(std::ceil(degrees / 90.0)));
    EXPECT_EQ(step.deform->certificate.flipped_triangles, 0U) << degrees;
    EXPECT_THAT(wound->report.warnings, IsEmpty()) << degrees;
  }
  EXPECT_EQ(run(twist(180))->report.steps[0].deform->commits, 1U);
}

// Applied in one step, the linear response to 300 degrees equals that to -60 degrees.
TEST_F(Winding, LinearSolutionsOfLargeTurnsAreMadeInPartsByThemselves) {
  for (const double degrees : {260.0, 300.0, -300.0}) {
    for (const char* keys : {R"(, "settle": false)", R"(, "settle": false, "response": "rsi")"}) {
      const auto result = run(twist(degrees, keys));
      EXPECT_NEAR(turns_of_circles(*result).back(), degrees, 1.0) << keys;
      EXPECT_GT(result->report.steps[0].deform->commits, 1U);
      for (const std::string& warning : result->report.warnings) {
        EXPECT_THAT(warning, ::testing::Not(HasSubstr("wound"))) << degrees << keys;
      }
    }
  }
}

TEST_F(Winding, LeftHandedTurnIsTheMirrorImage) {
  const auto result = run(twist(-260, kCommits));
  EXPECT_NEAR(turns_of_circles(*result).back(), -260.0, 1.0);
  EXPECT_NEAR(result->report.steps[0].deform->winding_degrees.value(), 260.0, 1.0);
}

TEST_F(Winding, TurnNearHalfATurnGoesTheWayItIsWritten) {
  for (const double degrees : {179.0, -179.0}) {
    const auto result = run(twist(degrees));
    EXPECT_NEAR(turns_of_circles(*result).back(), degrees, 1.0);
    EXPECT_THAT(result->report.warnings, IsEmpty());
  }
}

TEST_F(Winding, ASmallDetailLengthKeepsAWholeTurn) {
  const auto result = run(twist(360, kResist));
  EXPECT_NEAR(turns_of_circles(*result).back(), 360.0, 1.0);
  EXPECT_NEAR(result->report.steps[0].deform->winding_degrees.value(), 360.0, 1.0);
  EXPECT_THAT(result->report.warnings, IsEmpty());
}

TEST(WindingWarning, TurnThatIsLostAllTheSameIsToldWithWhatToChange) {
  DeformRequest step;
  SimilarityMove move;
  move.rotate = {Vector3d::UnitZ(), 360.0};
  step.handles.push_back({{}, move});
  step.parameters.commit_every = 180.0;
  step.parameters.detail_length = 0.1;
  EXPECT_THAT(winding_warning(step, 0.0),
              HasSubstr("turns by 360 degrees, but the surface is wound by 0 degrees. To correct "
                        "this, set \"detail_length\" to 0.05 (or --detail-length 0.05)"));
  step.parameters.detail_length = 0.02;
  EXPECT_THAT(winding_warning(step, 0.0), HasSubstr("turn less, or choose a longer region"));
}

TEST_F(Winding, LinearSolutionInSmallPartsKeepsItToo) {
  const auto result = run(twist(260, R"(, "settle": false, "commit_every": 20)"));
  EXPECT_EQ(result->report.steps[0].deform->commits, 13U);
  EXPECT_NEAR(turns_of_circles(*result).back(), 260.0, 1.0);
}

TEST_F(Winding, CertificateOfPartsIsThatOfTheWholeStep) {
  const auto result = run(twist(260, kCommits));
  const Certificate& certificate = result->report.steps[0].deform->certificate;
  EXPECT_GT(certificate.detail_error, 0.06) << "more than either part loses alone";
  double handle_error = 0.0;
  const Eigen::AngleAxisd turn(260.0 * std::numbers::pi / 180.0, Vector3d::UnitZ());
  for (Index v = 0; v < result->mesh.vertex_count(); ++v) {
    if (result->original[v].z() < 5.41) continue;
    handle_error =
        std::max(handle_error, (result->mesh.positions[v] - turn * result->original[v]).norm());
  }
  EXPECT_NEAR(certificate.handle_error, handle_error, 1e-9);
}

TEST_F(Winding, CommitsOfTheOtherHandlesKeepStep) {
  const std::string two_handles = R"({"op": "deform", "roi": {"all": true},
      "belt": {"box": {"min": [-1, -1, 2.9], "max": [1, 1, 3.1]}},
      "commit_every": 100, "constraint_weight": 10, "handles": [
        {"region": {"box": {"min": [-1, -1, 5.41], "max": [1, 1, 7]}},
         "move": {"rotate": {"axis": [0, 0, 1], "degrees": 190}}},
        {"region": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.59]}},
         "move": {"translate": [0.2, 0, 0]}}]})";
  const auto result = run(two_handles);
  const StepReport& step = result->report.steps[0];
  EXPECT_EQ(step.deform->commits, 2U);
  EXPECT_NEAR(step.deform->winding_degrees.value(), 190.0, 1.0);
  EXPECT_NEAR(result->mesh.positions[0].x() - result->original[0].x(), 0.2, 1e-3);
}

TEST_F(Winding, StillHandleServesInPlaceOfABelt) {
  const auto result = run(R"({"op": "deform", "roi": {"all": true}, "belt": {"vertices": []},
      "commit_every": 130, "handles": [
        {"region": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.59]}}, "move": {}},
        {"region": {"box": {"min": [-1, -1, 5.41], "max": [1, 1, 7]}},
         "move": {"rotate": {"axis": [0, 0, 1], "degrees": 260}}}]})");
  EXPECT_NEAR(turns_of_circles(*result).back(), 260.0, 1.0);
  EXPECT_FALSE(result->report.steps[0].deform->winding_degrees.has_value()) << "nothing stays";
}

TEST_F(Winding, TooManyCommitsAreRefused) {
  const std::string message =
      error_message<InputError>([&] { run(twist(1e9, R"(, "commit_every": 1)")); });
  EXPECT_THAT(message, HasSubstr("step 1: a handle turns by 1e+09 degrees"));
  EXPECT_THAT(message, HasSubstr("more than 1000 commits"));
}

TEST_F(Winding, StepThatDoesNotTurnIsTheSameWithCommitsAndWithout) {
  const auto with = run(twist(0, kCommits));
  EXPECT_EQ(with->mesh.positions, with->original);
  EXPECT_EQ(with->report.steps[0].deform->commits, 1U);
  EXPECT_FALSE(with->report.steps[0].deform->winding_degrees.has_value());
}

TEST_F(Winding, HardConstraintsAreMetExactlyAfterAllParts) {
  const auto result = run(twist(260, R"(, "commit_every": 130, "hard": true)"));
  EXPECT_LT(result->report.steps[0].deform->certificate.handle_error, 1e-13);
  for (Index v = 0; v < result->mesh.vertex_count(); ++v) {
    if (result->original[v].z() > 0.59) continue;
    EXPECT_EQ(result->mesh.positions[v], result->original[v]) << "of the belt";
  }
  EXPECT_NEAR(turns_of_circles(*result).back(), 260.0, 1.0);
}

}  // namespace
}  // namespace lapwing
