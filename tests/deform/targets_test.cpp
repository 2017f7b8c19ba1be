// Landmarks: points of the surface that are drawn to places.
#include "lapwing/region/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Index> below(Index end) {
  std::vector<Index> list(end);
  std::iota(list.begin(), list.end(), Index{0});
  return list;
}

class ATarget : public ::testing::Test {
 protected:
  ATarget() {
    request_.roi = {AllVertices{}, "roi"};
    request_.belt = RegionSpec{ListedVertices{ends_.belt}};
  }
  Vector3d side() const { return mesh_.positions[kVertex] + Vector3d(0.3, 0.1, 0.0); }
  Deformed done() const { return deform(mesh_, request_); }
  std::string error() const {
    return error_message<InputError>([&] { done(); });
  }

  static constexpr Index kVertex = 150;
  const Mesh mesh_ = test::bumpy_tube();
  const EditRegion ends_ = test::foot_and_head(mesh_);
  DeformRequest request_;
};

TEST_F(ATarget, DrawsASurfaceWithoutHandles) {
  request_.targets.rows = {{kVertex, side(), 10.0}};
  const Deformed deformed = done();
  EXPECT_LT((deformed.mesh.positions[kVertex] - side()).norm(), 0.02);
  EXPECT_DOUBLE_EQ(deformed.certificate.target_error,
                   (deformed.mesh.positions[kVertex] - side()).norm());
  EXPECT_TRUE(deformed.certificate.settled);
  EXPECT_THAT(deformed.warnings, IsEmpty());
}

TEST_F(ATarget, IsReachedExactlyWhereItIsHard) {
  request_.targets = {.rows = {{kVertex, side()}}, .hard = true};
  EXPECT_EQ(done().mesh.positions[kVertex], side());
}

TEST_F(ATarget, DrawsMoreTheMoreItWeighs) {
  double last = 1.0;
  for (const double weight : {0.1, 1.0, 10.0}) {
    request_.targets.rows = {{kVertex, side(), weight}};
    const double error = done().certificate.target_error;
    EXPECT_LT(error, last) << weight;
    last = error;
  }
}

// The same vertex as a handle that is held by the same weight, or as firmly.
TEST_F(ATarget, IsAHandleOfOneVertex) {
  DeformRequest by_handle = request_;
  SimilarityMove move;
  move.translate = side() - mesh_.positions[kVertex];
  by_handle.handles = {{{ListedVertices{{kVertex}}}, move, Falloff{.weight = 1.0}}};
  for (const bool hard : {false, true}) {
    by_handle.parameters.hard = request_.parameters.hard = hard;
    request_.targets = {.rows = {{kVertex, side()}}, .hard = hard};
    const Positions a = deform(mesh_, by_handle).mesh.positions;
    const Positions b = done().mesh.positions;
    EXPECT_LT(test::largest_distance(a, b), 1e-4) << hard;
  }
}

TEST_F(ATarget, MayLieWithinATriangle) {
  const auto& [a, b, c] = mesh_.topology().triangles[200];
  const Vector3d point = (mesh_.positions[a] + mesh_.positions[b] + 2.0 * mesh_.positions[c]) / 4.0;
  const Vector3d there = point + Vector3d(0.1, -0.2, 0.1);
  for (const bool hard : {false, true}) {
    request_.targets = {.rows = {{point, there, 10.0}}, .hard = hard};
    const Deformed deformed = done();
    const Positions& p = deformed.mesh.positions;
    const Vector3d now = (p[a] + p[b] + 2.0 * p[c]) / 4.0;
    EXPECT_NEAR((now - there).norm(), deformed.certificate.target_error, 1e-12);
    EXPECT_LT((now - there).norm(), hard ? 1e-6 : 0.02);
    EXPECT_TRUE(deformed.certificate.settled);
  }
}

TEST_F(ATarget, IsReachedWithinATriangleOfTheBeltIfItIsHard) {
  const auto& [a, b, c] = mesh_.topology().triangles[10];
  ASSERT_LT(std::max({a, b, c}), 48U);
  request_.belt = RegionSpec{ListedVertices{below(48)}};
  const Vector3d point = (mesh_.positions[a] + mesh_.positions[b] + 2.0 * mesh_.positions[c]) / 4.0;
  const Vector3d there = point + Vector3d(0.05, 0.0, 0.02);
  request_.targets = {.rows = {{point, there}}, .hard = true};
  for (const bool hard_belt : {false, true}) {
    request_.parameters.hard = hard_belt;
    EXPECT_LT(done().certificate.target_error, 1e-6) << hard_belt;
  }
}

TEST_F(ATarget, StandsBesideHandles) {
  SimilarityMove up;
  up.translate = {0.0, 0.0, 0.3};
  request_.handles = {{{ListedVertices{ends_.handles[0]}}, up}};
  request_.targets = {.rows = {{kVertex, side()}}, .hard = true};
  const Deformed deformed = done();
  EXPECT_EQ(deformed.mesh.positions[kVertex], side());
  EXPECT_LT(deformed.certificate.handle_error, 0.05);
}

TEST_F(ATarget, IsApproachedInPartsWithTheHandles) {
  SimilarityMove turn;
  turn.rotate = {Vector3d::UnitZ(), 120.0};
  request_.handles = {{{ListedVertices{ends_.handles[0]}}, turn}};
  request_.parameters.commit_every = 60.0;
  request_.targets = {.rows = {{kVertex, side()}}, .hard = true};
  const Deformed deformed = done();
  EXPECT_EQ(deformed.commits, 2U);
  EXPECT_LT((deformed.mesh.positions[kVertex] - side()).norm(), 1e-12);
}

TEST_F(ATarget, MovesThePaperSystemAndTheLinearTangentToo) {
  request_.targets.rows = {{kVertex, side(), 10.0}};
  request_.parameters.settle.reset();
  for (const LinearResponse response : {LinearResponse::rsi, LinearResponse::tangent}) {
    request_.parameters.response = response;
    const Deformed deformed = done();
    EXPECT_LT(deformed.certificate.relative_residual, 1e-9);
    EXPECT_LT(deformed.certificate.target_error, 0.02);
  }
}

TEST_F(ATarget, TakesItsVertexFromABeltByFraction) {
  const Mesh sheet = grid(10, 10);
  DeformRequest lift;
  lift.roi = {AllVertices{}, "roi"};
  lift.belt = BoundaryAnchors{0.5, "belt"};
  const Index near_border = 12;
  lift.targets = {.rows = {{near_border, sheet.positions[near_border] + Vector3d(0, 0, 0.05)}},
                  .hard = true};
  const Deformed deformed = deform(sheet, lift);
  EXPECT_FALSE(
      std::binary_search(deformed.region.belt.begin(), deformed.region.belt.end(), near_border));
  EXPECT_DOUBLE_EQ(deformed.mesh.positions[near_border].z(), 0.05);
}

TEST_F(ATarget, ThatIsSaidTwiceCountsOnce) {
  request_.targets.rows = {{kVertex, side()}};
  const Positions once = done().mesh.positions;
  request_.targets.rows.push_back({kVertex, side(), 5.0});
  EXPECT_EQ(done().mesh.positions, once);
}

TEST_F(ATarget, ThatCannotBeIsNamedByItsRow) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  request_.targets.rows = {{kVertex, side()}, {kVertex, side() * 2.0}};
  EXPECT_EQ(error(),
            "targets: row 1: vertex 150 has another position in row 0. Remove one of the "
            "two rows");
  request_.targets.rows = {{Index{999}, side()}};
  EXPECT_EQ(error(), "targets: row 0: the mesh has no vertex 999, only 0 to 239");
  request_.targets.rows = {{kVertex, {0.0, nan, 0.0}}};
  EXPECT_EQ(error(), "targets: row 0: its position is not finite");
  request_.targets.rows = {{Vector3d(nan, 0.0, 0.0), side()}};
  EXPECT_EQ(error(), "targets: row 0: its point is not finite");
  request_.targets.rows = {{kVertex, side(), 0.0}};
  EXPECT_THAT(error(), HasSubstr("row 0: expected a weight from 0.000001 to"));
  request_.targets.rows = {{ends_.belt.front(), side()}};
  EXPECT_THAT(error(), HasSubstr("row 0: vertex 0 also belongs to the belt or a handle"));
  request_.roi = {ListedVertices{ends_.belt}, "roi"};
  request_.targets.rows = {{kVertex, side()}};
  EXPECT_THAT(error(), HasSubstr("row 0: vertex 150 is outside the ROI"));
  request_.targets.rows = {};
  EXPECT_EQ(error(), "deform: nothing is moved; give at least one handle or target");
}

TEST(TargetRow, IsReadByItsLength) {
  const TargetRow vertex = target_row(std::array{3.0, 1.0, 2.0, 4.0}, "here");
  EXPECT_EQ(std::get<Index>(vertex.point), 3U);
  EXPECT_EQ(vertex.position, Vector3d(1.0, 2.0, 4.0));
  EXPECT_EQ(vertex.weight, 1.0);
  EXPECT_EQ(target_row(std::array{3.0, 1.0, 2.0, 4.0, 9.0}, "here").weight, 9.0);
  const TargetRow point = target_row(std::array{0.1, 0.2, 0.3, 1.0, 2.0, 4.0, 8.0}, "here");
  EXPECT_EQ(std::get<Vector3d>(point.point), Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(point.position, Vector3d(1.0, 2.0, 4.0));
  EXPECT_EQ(point.weight, 8.0);
  const auto error = [](std::span<const double> numbers) {
    return error_message<InputError>([&] { target_row(numbers, "a.csv:3"); });
  };
  EXPECT_THAT(error(std::array{1.0, 2.0, 3.0}), HasSubstr("a.csv:3: expected 4 numbers"));
  EXPECT_THAT(error(std::array{1.5, 2.0, 3.0, 4.0}),
              HasSubstr("a.csv:3: expected the number of a vertex"));
  EXPECT_THAT(error(std::array{-1.0, 2.0, 3.0, 4.0}), HasSubstr("the number of a vertex"));
}

}  // namespace
}  // namespace lapwing
