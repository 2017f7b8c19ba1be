#include "lapwing/deform/proxy_drag.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include <gtest/gtest.h>

#include "lapwing/deform/drag_session.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/largest_distance.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::AngleAxisd;
using Eigen::Vector3d;
using test::largest_distance;

// Returns the motions of a handle that bends the cylinder by `degrees`.
HandleMotions bent(double degrees) {
  return {{test::turn_and_move(degrees, Vector3d::UnitX(), Vector3d(0.0, 0.01 * degrees, 0.0))},
          {AngleAxisd(degrees * std::numbers::pi / 180.0, Vector3d::UnitX())}};
}

class ADragByItsProxy : public ::testing::Test {
 protected:
  std::shared_ptr<const DeformSolver> solver(const EditRegion& region) {
    return std::make_shared<const DeformSolver>(mesh_.positions, mesh_.topology(), region,
                                                DeformOptions{}, kernels_);
  }
  void begin(const EditRegion& region) {
    solver_ = solver(region);
    drag_ = ProxyDrag::make(solver_);
    ASSERT_NE(drag_, nullptr);
    frame_.emplace(drag_->problem());
    frame_->begin(drag_->begin({}));
  }
  void step(const HandleMotions& motions) {
    const DragFrameInput* const input = drag_->step(motions);
    ASSERT_NE(input, nullptr);
    frame_->step(*input);
  }
  void bend_to(double degrees) {
    for (double part = 3.0; part <= degrees; part += 3.0) step(bent(part));
  }
  Positions positions() const { return moved_by(drag_->pose(frame_->displacement())); }
  Positions moved_by(const DragState& pose) const {
    Positions positions = mesh_.positions;
    for (std::size_t v = 0; v < positions.size(); ++v) positions[v] += pose.displacement[v];
    return positions;
  }

  Mesh mesh_ = test::rippled_cylinder();
  const double diagonal_ = bounds_of(mesh_.positions).diagonal();
  const EditRegion ends_ = test::ends_of_cylinder(mesh_);
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_;
  std::unique_ptr<ProxyDrag> drag_;
  std::optional<CpuDragFrame> frame_;
};

// Compares with a DragSession whose frames have time only for the proxy.
TEST_F(ADragByItsProxy, IsAsCloseToTheSettledSurfaceAsADragSession) {
  begin(ends_);
  DragSession session(solver_);
  session.wait_until_prepared();
  for (double degrees = 3.0; degrees <= 60.0; degrees += 3.0) {
    step(bent(degrees));
    session.step(bent(degrees), [](double ms) { return ms == 0.0; });
  }
  const Positions settled = solver_->solve(bent(60.0)).positions;
  EXPECT_LT(largest_distance(positions(), settled),
            largest_distance(moved_by(session.state()), settled));
}

TEST_F(ADragByItsProxy, PlacesTheHandleExactlyAndKeepsTheBelt) {
  begin(ends_);
  bend_to(30.0);
  const Positions now = positions();
  for (const Index v : ends_.belt) EXPECT_EQ(now[v], mesh_.positions[v]);
  const Affine3d map = bent(30.0).maps[0];
  for (const Index v : ends_.handles[0])
    EXPECT_LT((now[v] - map * mesh_.positions[v]).norm(), 1e-9);
}

TEST_F(ADragByItsProxy, LeavesASurfaceAtRestAtRest) {
  begin(ends_);
  for (int frame = 0; frame < 3; ++frame) step(bent(0.0));
  EXPECT_LT(largest_distance(positions(), mesh_.positions), 1e-9 * diagonal_);
}

TEST_F(ADragByItsProxy, EndsInTheMinimumNearItsPose) {
  begin(ends_);
  bend_to(45.0);
  const DragState pose = drag_->pose(frame_->displacement());
  const Positions settled = solver_->solve_from(pose, bent(45.0)).positions;
  EXPECT_LT(largest_distance(settled, solver_->solve(bent(45.0)).positions), 1e-4 * diagonal_);
}

TEST_F(ADragByItsProxy, LeavesOtherEditsToDragSessions) {
  EditRegion region = ends_;
  region.targets.push_back({.corners = {3000, 3000, 3000}, .position = Vector3d(1, 0, 3)});
  EXPECT_EQ(ProxyDrag::make(solver(region)), nullptr);
  begin(ends_);
  HandleMotions wider = bent(3.0);
  wider.maps[0] = wider.maps[0] * Eigen::Scaling(1.5);
  EXPECT_EQ(drag_->step(wider), nullptr);
  EXPECT_EQ(drag_->step(bent(120.0)), nullptr) << "it turns too far for one frame";
  HandleMotions free = bent(3.0);
  free.is_free = {1};
  EXPECT_EQ(drag_->step(free), nullptr);
  step(bent(3.0));
}

}  // namespace
}  // namespace lapwing
