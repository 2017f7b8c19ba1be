// Runs recipes with the step "wrap".
#include <fstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/wrap/wrap.h"
#include "run/recipe_runs.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class WrapRun : public test::RecipeRuns {
 protected:
  WrapRun() : RecipeRuns("ball.ply") {}

  void SetUp() override {
    write(icosphere(2), "ball.ply");
    for (Vector3d& p : egg_.positions) p = p.cwiseProduct(Vector3d(1.0, 1.2, 1.5));
    write(egg_, "egg.ply");
  }

  Mesh egg_ = icosphere(3);
};

TEST_F(WrapRun, IsTheWrapOfBothMeshes) {
  const auto result = run(R"({"op": "wrap", "scan": "egg.ply", "aligned": true})");
  const Wrapped expected = wrap(read("ball.ply"), read("egg.ply"), {.aligned = true}, cpu_);
  EXPECT_EQ(result->mesh.positions, expected.positions);
  EXPECT_EQ(result->original, read("ball.ply").positions);
  EXPECT_THAT(result->report.warnings, IsEmpty());
  EXPECT_THAT(result->inputs, ElementsAre(folder_ / "ball.ply", folder_ / "egg.ply"));
  const StepReport& step = result->report.steps.at(0);
  EXPECT_EQ(step.op, "wrap");
  EXPECT_EQ(step.roi, icosphere(2).vertex_count());
  ASSERT_TRUE(step.wrap.has_value());
  EXPECT_EQ(step.wrap->to_scan.mean, expected.report.to_scan.mean);
  EXPECT_EQ(step.wrap->self_intersecting, 0U);
  EXPECT_EQ(step.wrap->scan_diagonal, bounds_of(read("egg.ply").positions).diagonal());
}

TEST_F(WrapRun, PassesOnHowTheTemplateIsWrapped) {
  const auto result = run(R"({"op": "wrap", "scan": "egg.ply", "landmarks": [[0, 0, 0, 1.6]],
      "aligned": true, "hard": true, "mirror": {"plane": "x"}, "detail": true})");
  WrapRequest request{.aligned = true, .mirror = MirrorSpec{MirrorPlane{}}, .detail = true};
  request.landmarks.rows = {{.point = Index{0}, .position = Vector3d(0.0, 0.0, 1.6)}};
  request.landmarks.hard = true;
  EXPECT_EQ(result->mesh.positions,
            wrap(read("ball.ply"), read("egg.ply"), request, cpu_).positions);
}

TEST_F(WrapRun, OtherStepsFollow) {
  const auto result = run(R"({"op": "wrap", "scan": "egg.ply", "aligned": true},
                             {"op": "subdivide"})");
  EXPECT_EQ(result->mesh.face_count(), 4 * icosphere(2).face_count());
  EXPECT_NEAR(bounds_of(result->mesh.positions).max.z(), 1.5, 0.02);
}

TEST_F(WrapRun, ReadsLandmarksBesideTheRecipe) {
  std::ofstream(folder_ / "ball.csv") << "label,x,y,z\na,0,0,1\nb,1,0,0\nc,0,1,0\nd,0,-1,0\n";
  std::ofstream(folder_ / "egg.csv") << "label,x,y,z\nc,0,1.2,0\na,0,0,1.5\nb,1,0,0\n";
  const auto result = run(R"({"op": "wrap", "scan": "egg.ply",
                              "landmarks": {"template": "ball.csv", "scan": "egg.csv"}})");
  EXPECT_EQ(result->report.steps.at(0).wrap->alignment.method, AlignmentMethod::landmarks);
  EXPECT_THAT(result->report.notes, ElementsAre(HasSubstr("no points labeled \"d\"")));
  EXPECT_THAT(result->inputs, ElementsAre(folder_ / "ball.ply", folder_ / "egg.ply",
                                          folder_ / "ball.csv", folder_ / "egg.csv"));
  EXPECT_THAT(refusal(R"({"op": "wrap", "scan": "egg.ply", "landmarks": [[4000, 0, 0, 0]]})"),
              AllOf(HasSubstr("/steps/0/landmarks/0"), HasSubstr("no vertex 4000")));
}

TEST_F(WrapRun, ReportsDistancesAndWhyTheResultIsNotUsable) {
  for (Vector3d& p : egg_.positions) p.x() = -p.x();  // turns the faces inward
  write(egg_, "inverted.ply");
  const auto result = run(R"({"op": "wrap", "scan": "inverted.ply", "aligned": true})");
  EXPECT_THAT(result->report.warnings, ElementsAre(HasSubstr("Only 0% of the template")));
  const auto json = nlohmann::json::parse(to_json(result->report))["steps"][0]["wrap"];
  EXPECT_EQ(json["alignment"], "none");
  EXPECT_EQ(json["coverage"], 0.0);
  EXPECT_EQ(json["trouble"], result->report.warnings[0]);
  EXPECT_GT(json["to_scan"]["percentile_95"], 0.0);
}

TEST_F(WrapRun, CountsTheTrianglesThatIntersectOnlyInTheResult) {
  // One landmark pulls its vertex to the other side.
  std::string rows;
  for (Index v = 0; v < 6; ++v) {
    const Vector3d p = (v == 3 ? -3.0 : 1.0) * icosphere(2).positions[v];
    rows += (v == 0 ? "[" : ", [") + std::to_string(v);
    for (const double x : p) rows += ", " + std::to_string(x);
    rows += "]";
  }
  const auto result =
      run(R"({"op": "wrap", "scan": "egg.ply", "aligned": true, "landmarks": [)" + rows + "]}");
  EXPECT_GT(result->report.steps.at(0).wrap->self_intersecting, 10U);
  const auto json = nlohmann::json::parse(to_json(result->report))["steps"][0]["wrap"];
  EXPECT_GT(json["self_intersecting_triangles"], 10);
}

}  // namespace
}  // namespace lapwing
