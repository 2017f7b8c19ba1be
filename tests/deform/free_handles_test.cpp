// Handles whose orientation is free.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/rotation.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::largest_distance;

HandleMotions freely(const Affine3d& map) {
  HandleMotions motions = handle_motions(std::array{map});
  motions.is_free = {1};
  return motions;
}

Affine3d shift(double x, double y, double z) {
  return Affine3d(Eigen::Translation3d(x, y, z));
}

class AFreeHandle : public ::testing::TestWithParam<int> {
 protected:
  Positions moved(const DragState& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }
  Vector3d centre(const Positions& positions) const {
    return handle_frame(region_.handles[0], positions).centroid;
  }

  // 1,830 vertices, which settle within a frame, or 7,260, which a coarse surface leads.
  Mesh mesh_ = test::rippled_cylinder(GetParam(), 2 * GetParam() + 1);
  Topology topology_ = mesh_.topology();
  CpuKernels kernels_;
  EditRegion region_ = test::ends_of_cylinder(mesh_);
  std::shared_ptr<const DeformSolver> solver_ = std::make_shared<const DeformSolver>(
      mesh_.positions, topology_, region_, DeformOptions(), kernels_);
};

TEST_P(AFreeHandle, TurnsToWhereAKeptOneIsAtRest) {
  const DeformResult free = solver_->solve(freely(shift(3.0, 0.0, -1.0)));
  ASSERT_TRUE(free.certificate.settled);
  const double turned = shortest_turn(free.motions.maps[0]).angle();
  EXPECT_GT(turned, 0.3) << "a tube that is bent sideways turns its end along";
  const DeformResult kept = solver_->solve(free.motions.maps);
  EXPECT_LT(largest_distance(free.positions, kept.positions), 1e-3);
  // The surface stretches more if the handle may not rotate.
  const DeformResult upright = solver_->solve(std::array{shift(3.0, 0.0, -1.0)});
  EXPECT_GT(upright.certificate.edge_stretch, free.certificate.edge_stretch);
  EXPECT_GT(upright.certificate.detail_error, free.certificate.detail_error);
}

TEST_P(AFreeHandle, GoesWithItsCentreToItsPlaceAndKeepsItsShape) {
  const Affine3d map = shift(2.0, 1.0, 0.0);
  const DeformResult free = solver_->solve(freely(map));
  EXPECT_LT((centre(free.positions) - map * centre(mesh_.positions)).norm(), 0.01);
  for (const Index v : region_.handles[0]) {
    const Vector3d place = free.motions.maps[0] * mesh_.positions[v];
    EXPECT_LT((free.positions[v] - place).norm(), 0.05) << v;
  }
}

TEST_P(AFreeHandle, DependsOnTheRotationOfItsMoveOnlyAsAStart) {
  const DeformResult free = solver_->solve(freely(shift(2.0, 0.0, 0.0)));
  const Vector3d centroid = centre(mesh_.positions);
  const Affine3d turned =
      turned_to(shift(2.0, 0.0, 0.0), centroid,
                Eigen::AngleAxisd(0.5, Vector3d(1.0, 2.0, 0.5).normalized()).toRotationMatrix());
  EXPECT_LT(largest_distance(solver_->solve(freely(turned)).positions, free.positions), 1e-3);
}

TEST_P(AFreeHandle, DraggedFrameByFrameEndsWhereTheSolutionIs) {
  DragSession drag(solver_);
  const DragState& pose = drag.state();
  for (int frame = 1; frame <= 20; ++frame) {
    int left = 4;
    drag.step(freely(shift(0.1 * frame, 0.0, 0.0)), [&left](double) { return left-- > 0; });
  }
  for (int frame = 0; frame < 200 && !pose.last_result.settled; ++frame) {
    drag.step(freely(shift(2.0, 0.0, 0.0)), [](double ms) { return ms < 1e9; });
  }
  ASSERT_TRUE(pose.last_result.settled);
  const Positions solved = solver_->solve(freely(shift(2.0, 0.0, 0.0))).positions;
  EXPECT_LT(largest_distance(moved(pose), solved), 2e-3);
}

TEST_P(AFreeHandle, ScalesAsItIsAsked) {
  Affine3d map = shift(1.0, 0.0, 0.0);
  const Vector3d centroid = centre(mesh_.positions);
  map.linear() *= 1.5;
  map.translation() += centroid - map.linear() * centroid;
  const DeformResult free = solver_->solve(freely(map));
  ASSERT_TRUE(free.certificate.settled);
  EXPECT_NEAR(std::cbrt(free.motions.maps[0].linear().determinant()), 1.5, 1e-9);
  const double before = handle_frame(region_.handles[0], mesh_.positions).radius;
  EXPECT_NEAR(handle_frame(region_.handles[0], free.positions).radius, 1.5 * before, 0.05);
}

INSTANTIATE_TEST_SUITE_P(Sizes, AFreeHandle, ::testing::Values(30, 60));

TEST(FreeHandles, OfAllThatIsHeldMoveTheSurfaceAsAWhole) {
  const Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  region.belt.clear();
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, mesh.topology(), region, {}, kernels);
  const DeformResult moved = deformer.solve(freely(shift(0.3, -0.2, 0.5)));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_LT((moved.positions[v] - mesh.positions[v] - Vector3d(0.3, -0.2, 0.5)).norm(), 1e-6);
  }
}

TEST(FreeHandles, OfOneVertexAreHeldByTheirPlaceAlone) {
  const Mesh mesh = test::bumpy_tube();
  EditRegion region = test::foot_and_head(mesh);
  region.handles[0].resize(1);
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, mesh.topology(), region, {}, kernels);
  const Affine3d map = shift(0.2, 0.0, 0.1);
  EXPECT_LT(largest_distance(deformer.solve(freely(map)).positions,
                             deformer.solve(std::array{map}).positions),
            1e-4);
}

TEST(FreeHandles, NeedASurfaceThatSettlesAndSoftConstraints) {
  const Mesh mesh = test::bumpy_tube();
  CpuKernels kernels;
  DeformOptions hard;
  hard.hard = true;
  DeformOptions linear;
  linear.settle.reset();
  for (const DeformOptions& options : {hard, linear}) {
    const DeformSolver deformer(mesh.positions, mesh.topology(), test::foot_and_head(mesh), options,
                                kernels);
    EXPECT_THAT(error_message<InputError>(
                    [&] { static_cast<void>(deformer.solve(freely(shift(0.1, 0.0, 0.0)))); }),
                ::testing::HasSubstr("keep its orientation"));
  }
}

}  // namespace
}  // namespace lapwing
