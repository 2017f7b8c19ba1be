#include "lapwing/deform/modifiers/attachments.h"

#include <algorithm>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/mesh/transform.h"
#include "support/error_message.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using ::testing::HasSubstr;

RegionSpec between(double low, double high) {
  return {Box{{-1, -1, low}, {1, 1, high}}};
}

class Attachments : public ::testing::Test {
 protected:
  // The handle is above z = 2.6. Below z = 0.4 the tube is fixed, or moves too if `moves_whole`.
  static DeformRequest request(const Move& move, bool moves_whole = false) {
    DeformRequest request;
    request.roi = {AllVertices{}};
    request.belt = between(-1.0, 0.4);
    request.handles = {{between(2.6, 4.0), move}};
    if (!moves_whole) return request;
    request.belt = RegionSpec{ListedVertices{}};
    request.handles.push_back({between(-1.0, 0.4), move});
    return request;
  }
  Deformed moved(const Move& move) const { return deform(tube_, request(move)); }
  CarriedPoints carried_by(const Positions& points, const Deformed& deformed) const {
    return carry_points(points, tube_.positions, deformed);
  }
  Positions around() const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> across(-1.0, 1.0);
    Positions points;
    for (int k = 0; k < 300; ++k) {
      points.emplace_back(across(random), across(random), 1.5 + 2.0 * across(random));
    }
    return points;
  }

  Mesh tube_ = cylinder(12, 20, 0.5, 3.0);
  double diagonal_ = bounds_of(tube_.positions).diagonal();
  SimilarityMove bend_{.translate = {0.5, 0.0, -0.3}, .rotate = {{0, 1, 0}, 50.0}};
};

TEST_F(Attachments, PointsAroundAStillSurfaceKeepTheirBits) {
  const Positions points = around();
  const CarriedPoints carried = carried_by(points, moved(SimilarityMove{}));
  EXPECT_EQ(carried.positions, points);
  for (const Quaterniond& q : carried.rotations) {
    EXPECT_EQ(q.coeffs(), Quaterniond::Identity().coeffs());
  }
}

TEST_F(Attachments, PointsMoveAndGrowWithASurfaceThatDoes) {
  const Positions points = around();
  for (const double scale : {1.0, 2.0}) {
    const SimilarityMove move{.translate = {3, -1, 2},
                              .rotate = {{1, 2, -1}, 130.0},
                              .scale = Vector3d::Constant(scale),
                              .pivot = Vector3d(0, 0, 1)};
    const Eigen::Affine3d motion = to_affine(move, Vector3d::Zero());
    const CarriedPoints carried = carried_by(points, deform(tube_, request(move, true)));
    const Quaterniond turn = unit_quaternion(motion.linear() / scale);
    for (std::size_t p = 0; p < points.size(); ++p) {
      EXPECT_LT((carried.positions[p] - motion * points[p]).norm(), scale == 1.0 ? 1e-9 : 1e-6);
      EXPECT_LT((carried.rotations[p].coeffs() - turn.coeffs()).norm(), 1e-6);
    }
  }
}

TEST_F(Attachments, PointsOnTheSurfaceStayOnIt) {
  const Deformed bent = moved(bend_);
  std::mt19937 random(9);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Positions points = tube_.positions;
  Positions expected = bent.mesh.positions;
  for (const Triangle& t : tube_.topology().triangles) {
    double u = share(random);
    double v = share(random);
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const auto at = [&](const Positions& from) {
      return Vector3d((1.0 - u - v) * from[t[0]] + u * from[t[1]] + v * from[t[2]]);
    };
    points.push_back(at(tube_.positions));
    expected.push_back(at(bent.mesh.positions));
  }
  const CarriedPoints carried = carried_by(points, bent);
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_LT((carried.positions[p] - expected[p]).norm(), 1e-12 * diagonal_) << p;
  }
}

TEST_F(Attachments, PointsNearTheHandleTurnWithIt) {
  const Positions points{{0.6, 0.0, 2.9}, {0.7, 0.0, 0.1}};
  const CarriedPoints carried = carried_by(points, moved(bend_));
  const auto degrees = [&](std::size_t p) {
    return 2.0 * std::acos(carried.rotations[p].w()) * 180.0 / std::numbers::pi;
  };
  EXPECT_NEAR(degrees(0), 50.0, 2.0);
  EXPECT_NEAR(degrees(1), 0.0, 2.0);
}

TEST_F(Attachments, PointsMoveContinuouslyThroughTheMiddleOfTheTube) {
  const Deformed bent = moved(bend_);
  Positions points;
  constexpr int kSteps = 2000;
  for (int k = 0; k <= kSteps; ++k) points.emplace_back(-0.8 + 1.6 * k / kSteps, 0.02, 1.7);
  const CarriedPoints carried = carried_by(points, bent);
  const double step = 1.6 / kSteps;
  double steepest = 0.0;
  for (std::size_t p = 1; p < points.size(); ++p) {
    const double moved = (carried.positions[p] - carried.positions[p - 1]).norm();
    steepest = std::max(steepest, moved / step);
  }
  EXPECT_LT(steepest, 3.0);
}

TEST_F(Attachments, PointsWhereNothingMovesKeepTheirBits) {
  DeformRequest upper = request(bend_);
  upper.roi = between(1.5, 4.0);
  upper.belt = BoundaryAnchors{};
  const Deformed bent = deform(tube_, upper);
  const Positions points{{0.6, 0.1, 0.3}, {0.0, 0.7, 1.0}, {0.6, 0.1, 2.0}};
  const CarriedPoints carried = carried_by(points, bent);
  EXPECT_EQ(carried.positions[0], points[0]);
  EXPECT_EQ(carried.positions[1], points[1]);
  EXPECT_NE(carried.positions[2], points[2]);
}

TEST_F(Attachments, PointsFollowALoosePartThatIsCarriedItself) {
  Mesh ball = icosphere(2);
  transform(ball, Eigen::Translation3d(0.8, 0, 2.8) * Eigen::Scaling(0.2));
  const Mesh both = test::joined(tube_, ball);
  DeformRequest with_ball = request(bend_);
  with_ball.handles[0].region = {Box{{-0.51, -0.51, 2.6}, {0.51, 0.51, 4.0}}};
  const Deformed bent = deform(both, with_ball);
  ASSERT_EQ(bent.region.loose.size(), 1U);
  const Positions tip{{1.1, 0.0, 2.8}};
  const CarriedPoints carried = carry_points(tip, both.positions, bent);
  Vector3d center = Vector3d::Zero();
  for (std::size_t v = tube_.vertex_count(); v < both.vertex_count(); ++v) {
    center += bent.mesh.positions[v] / static_cast<double>(ball.vertex_count());
  }
  EXPECT_NEAR((carried.positions[0] - center).norm(), 0.3, 1e-3);
  EXPECT_GT((carried.positions[0] - tip[0]).norm(), 0.3);
}

TEST_F(Attachments, KnownSharesCarryToTheSameBits) {
  const Positions points = around();
  const auto contacts = std::make_shared<const SurfaceContacts>(tube_.positions, tube_.topology());
  const CarryShares shares = contacts->find_all(points, 1'000'000).value();
  for (std::size_t p = 0; p < points.size(); ++p) {
    double sum = 0.0;
    for (const CarryShare& of : shares[p]) sum += of.share;
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
  for (const double degrees : {0.0, 20.0, 50.0}) {
    bend_.rotate.degrees = degrees;
    const Deformed bent = moved(bend_);
    const CarriedPoints carried = AttachmentDeformer(contacts, bent).carry(points, shares);
    EXPECT_EQ(carried.positions, carried_by(points, bent).positions);
  }
  EXPECT_FALSE(contacts->find_all(points, shares.values.size() - 1));
}

TEST_F(Attachments, FilesAreNoBusinessOfADeformInMemory) {
  DeformRequest with_hat = request(bend_);
  with_hat.carry = {{"hat.obj"}};
  EXPECT_THAT(error_message<InputError>([&] { deform(tube_, with_hat); }),
              HasSubstr("hat.obj cannot be carried by this function"));
}

}  // namespace
}  // namespace lapwing
