// Tests that components without constraints follow the nearest surface.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/joined_meshes.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using ::testing::HasSubstr;

Mesh ball(const Vector3d& center, double radius) {
  Mesh mesh = icosphere(1);
  for (Vector3d& p : mesh.positions) p = center + radius * p;
  return mesh;
}

class ALoosePart : public ::testing::Test {
 protected:
  // A tube with a ball that sits on its side, above the middle.
  ALoosePart() {
    double top = 0.0;
    for (const Vector3d& p : tube_.positions) top = std::max(top, p.z());
    double side = 0.0;
    for (const Vector3d& p : tube_.positions) {
      if (std::abs(p.z() - 0.7 * top) < 0.1 * top) side = std::max(side, p.x());
    }
    ball_at_ = {side + 0.22, 0.0, 0.7 * top};
    mesh_ = test::joined(tube_, ball(ball_at_, 0.2));
    request_.roi = {AllVertices{}, "roi"};
    request_.belt = RegionSpec{ListedVertices{ends_.belt}};
    request_.handles = {{{ListedVertices{ends_.handles[0]}}, SimilarityMove{}}};
  }

  SimilarityMove& move() { return std::get<SimilarityMove>(request_.handles[0].move); }
  Index first_of_ball() const { return static_cast<Index>(tube_.vertex_count()); }
  // The least distance from the ball to the vertices of the tube.
  double gap(const Positions& positions) const {
    double least = 1e9;
    for (std::size_t b = first_of_ball(); b < positions.size(); ++b) {
      for (Index v = 0; v < first_of_ball(); ++v) {
        least = std::min(least, (positions[b] - positions[v]).norm());
      }
    }
    return least;
  }
  void expect_rigid(const Positions& positions, double scale) const {
    for (std::size_t a = first_of_ball(); a < positions.size(); ++a) {
      for (std::size_t b = first_of_ball(); b < a; ++b) {
        EXPECT_NEAR((positions[a] - positions[b]).norm(),
                    scale * (mesh_.positions[a] - mesh_.positions[b]).norm(), 1e-12);
      }
    }
  }

  const Mesh tube_ = test::bumpy_tube();
  const EditRegion ends_ = test::foot_and_head(tube_);
  Vector3d ball_at_;
  Mesh mesh_;
  DeformRequest request_;
};

TEST_F(ALoosePart, RidesAlongRigidlyAndStaysWhereItTouches) {
  move().translate = {1.0, 0.0, -0.5};
  move().rotate = {Vector3d::UnitY(), 70.0};
  const Deformed deformed = deform(mesh_, request_);
  expect_rigid(deformed.mesh.positions, 1.0);
  const double diagonal = bounds_of(mesh_.positions).diagonal();
  EXPECT_NEAR(gap(deformed.mesh.positions), gap(mesh_.positions), 0.01 * diagonal);
  const Index v = first_of_ball();
  EXPECT_GT((deformed.mesh.positions[v] - mesh_.positions[v]).norm(), 0.1);
  ASSERT_FALSE(deformed.notes.empty());
  EXPECT_EQ(deformed.notes[0], "deform: 1 loose component with 42 vertices, starting at vertex " +
                                   std::to_string(v) + ": carried along with the nearest surface");
}

TEST_F(ALoosePart, LeavesTheSurfaceAsItIsWithoutThePart) {
  move().translate = {1.0, 0.0, -0.5};
  const Positions with = deform(mesh_, request_).mesh.positions;
  const Positions alone = deform(tube_, request_).mesh.positions;
  EXPECT_EQ(Positions(with.begin(), with.begin() + first_of_ball()), alone);
}

TEST_F(ALoosePart, GoesByTheMotionThatAllGoesBy) {
  request_.belt = RegionSpec{ListedVertices{}};
  move().translate = {1.0, 2.0, 3.0};
  move().rotate = {Vector3d(1.0, 2.0, -1.0).normalized(), 130.0};
  move().scale.setConstant(2.0);
  const Affine3d motion = to_affine(request_.handles[0].move,
                                    handle_frame(ends_.handles[0], mesh_.positions).centroid, 1.0);
  const Deformed deformed = deform(mesh_, request_);
  for (std::size_t v = first_of_ball(); v < mesh_.vertex_count(); ++v) {
    EXPECT_LT((deformed.mesh.positions[v] - motion * mesh_.positions[v]).norm(), 1e-6);
  }
}

TEST_F(ALoosePart, KeepsItsBitsWhereNothingMoves) {
  EXPECT_EQ(deform(mesh_, request_).mesh.positions, mesh_.positions);
}

TEST_F(ALoosePart, FollowsADragToFirstOrder) {
  CpuKernels kernels;
  const EditRegion region = resolve_edit_region(
      request_.roi, request_.belt, std::array{HandleSpec{request_.handles[0].region}}, mesh_);
  DeformOptions options;
  options.settle.emplace().tolerance = 1e-9;
  const DeformSolver deformer(mesh_.positions, mesh_.topology(), region, options, kernels);
  Drag drag(deformer.response());
  const double step = 1e-5;
  const Affine3d motion =
      Eigen::Translation3d(0.3 * step, -step, 0.2 * step) * AngleAxisd(step, Vector3d::UnitY());
  Positions dragged = mesh_.positions;
  drag.move(std::array{motion}, dragged);
  const Positions settled = deformer.solve(std::array{motion}).positions;
  double largest = 0.0;
  for (std::size_t v = first_of_ball(); v < mesh_.vertex_count(); ++v) {
    EXPECT_LT((dragged[v] - settled[v]).norm(), 0.02 * step);
    largest = std::max(largest, (settled[v] - mesh_.positions[v]).norm());
  }
  EXPECT_GT(largest, 0.2 * step);
}

TEST_F(ALoosePart, ThatIsHeldOnOneLineStaysThere) {
  // Two vertices of the ball belong to the belt: it turns about them.
  VertexSet belt = ends_.belt;
  belt.push_back(first_of_ball());
  belt.push_back(first_of_ball() + 1);
  request_.belt = RegionSpec{ListedVertices{belt}};
  move().translate = {1.0, 0.0, -0.5};
  const Deformed deformed = deform(mesh_, request_);
  ASSERT_THAT(deformed.region.loose, ::testing::SizeIs(1));
  EXPECT_EQ(deformed.region.belt, ends_.belt);
  expect_rigid(deformed.mesh.positions, 1.0);
  for (const Index v : {first_of_ball(), first_of_ball() + 1}) {
    EXPECT_LT((deformed.mesh.positions[v] - mesh_.positions[v]).norm(), 0.02);
  }
}

TEST_F(ALoosePart, StaysOrIsRefusedWhereThatIsAsked) {
  move().translate = {1.0, 0.0, -0.5};
  request_.parameters.loose = LoosePolicy::leave;
  const Deformed left = deform(mesh_, request_);
  for (std::size_t v = first_of_ball(); v < mesh_.vertex_count(); ++v) {
    EXPECT_EQ(left.mesh.positions[v], mesh_.positions[v]);
  }
  EXPECT_THAT(left.notes, ::testing::Contains(HasSubstr("left in place")));
  request_.parameters.loose = LoosePolicy::refuse;
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request_); }),
              HasSubstr("has no anchor"));
}

TEST_F(ALoosePart, CannotBeAllThatAHandleHolds) {
  request_.handles[0].region = {ListedVertices{{first_of_ball()}}};
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request_); }),
              HasSubstr("can turn freely"));
}

TEST(ASurfaceHeldOnOneLine, TurnsAsLittleAsItCan) {
  const Mesh sheet = grid(6, 6);
  DeformRequest request;
  request.roi = {AllVertices{}, "roi"};
  request.belt = RegionSpec{ListedVertices{{0, 1}}};
  SimilarityMove up;
  up.translate = {0.1, 0.0, 0.0};
  request.handles = {{{ListedVertices{{6}}}, up}};
  const Deformed deformed = deform(sheet, request);
  EXPECT_THAT(deformed.notes, ::testing::Contains(HasSubstr("belt and handles lie on one line")));
  EXPECT_TRUE(deformed.certificate.settled);
  // Stretching the sheet in its plane does not move it out of the plane.
  for (const Vector3d& p : deformed.mesh.positions) EXPECT_NEAR(p.z(), 0.0, 1e-6);
  request.parameters.loose = LoosePolicy::refuse;
  EXPECT_THAT(error_message<InputError>([&] { deform(sheet, request); }),
              HasSubstr("can turn freely"));
}

}  // namespace
}  // namespace lapwing
