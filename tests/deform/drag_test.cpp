// Tests linear drags: responses to a subset of the handles, and drags before the solver is ready.
#include "lapwing/deform/drag.h"

#include <array>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/dragged.h"
#include "support/largest_distance.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::largest_distance;

// A cylinder held at its foot, with three handles: a single vertex, a ring of it, and its top.
class CylinderOfThreeHandles : public ::testing::Test {
 protected:
  CylinderOfThreeHandles() {
    region_ = test::ends_of_cylinder(mesh_);
    const VertexSet top = region_.handles[0];
    region_.handles = {{}, {}, top};
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double z = mesh_.positions[v].z();
      if (z > 3.9 && z < 4.1) region_.handles[1].push_back(v);
      if (region_.handles[0].empty() && z > 2.0) region_.handles[0].push_back(v);
    }
    solver_ = std::make_shared<const DeformSolver>(mesh_.positions, topology_, region_,
                                                   DeformOptions(), kernels_);
  }

  static std::vector<Affine3d> motions(double first, double second, double third) {
    return {Affine3d(Eigen::Translation3d(first, 0, 0)),
            test::turn_and_move(second, Vector3d::UnitZ(), Vector3d::Zero()),
            Affine3d(Eigen::Translation3d(0, third, 0))};
  }
  // The settled surface at these motions.
  std::shared_ptr<const DragState> pose_at(const std::vector<Affine3d>& at) const {
    DragSession drag(solver_);
    return std::make_shared<const DragState>(drag.step(at));
  }

  Mesh mesh_ = test::rippled_cylinder(16, 31);
  Topology topology_ = mesh_.topology();
  EditRegion region_;
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_;
};

TEST_F(CylinderOfThreeHandles, ColumnsOfSomeAreThoseAmongAll) {
  const auto all = solver_->response();
  const std::array<std::size_t, 3> some{2, 0, 2};
  const auto response = solver_->response_of(some);
  EXPECT_EQ(response->handles(), (std::vector<std::size_t>{0, 2}));
  const std::size_t of_handle = all->columns().numbers.size() / 3;
  const auto numbers = response->columns().numbers;
  ASSERT_EQ(numbers.size(), 2 * of_handle);
  for (std::size_t k = 0; k < of_handle; ++k) {
    ASSERT_EQ(numbers[k], all->columns().numbers[k]);
    ASSERT_EQ(numbers[of_handle + k], all->columns().numbers[2 * of_handle + k]);
  }
}

TEST_F(CylinderOfThreeHandles, ColumnsOfAPreviewAreThoseAmongAll) {
  PreparedRegion prepared(topology_);
  const DragPreview all(prepared, mesh_.positions, region_, {});
  const std::array<std::size_t, 1> last{2};
  const DragPreview some(prepared, mesh_.positions, region_, {}, last);
  const auto to = motions(0, 0, 0.7);
  EXPECT_EQ(test::dragged(some.response(), to), test::dragged(all.response(), to));
  EXPECT_EQ(test::dragged(all.response_of(last), to), test::dragged(all.response(), to));
}

TEST_F(CylinderOfThreeHandles, DragOfOneGoesOnFromWhereTheOthersHaveMoved) {
  const auto pose = pose_at(motions(0.2, 20.0, 0.0));
  const auto to = motions(0.2, 20.0, 0.5);
  const std::array<std::size_t, 1> last{2};
  const Positions by_all = test::dragged(solver_->response(), to, pose);
  const Positions by_one = test::dragged(solver_->response_of(last), to, pose);
  EXPECT_LT(largest_distance(by_one, by_all), 1e-12);
  EXPECT_GT(
      largest_distance(by_one, test::dragged(solver_->response(), motions(0.2, 20.0, 0.0), pose)),
      0.3);
}

TEST_F(CylinderOfThreeHandles, MotionsMustBeThoseOfAllHandles) {
  const std::array<std::size_t, 1> first{0};
  Drag drag(solver_->response_of(first));
  EXPECT_THROW(drag.parameters(std::vector<Affine3d>(1, Affine3d::Identity())), InputError);
}

TEST(DragPreview, HardHandlesGoWhereTheyShouldEachByItsOwnMotion) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back({118, 119, 120, 121});
  DeformOptions options;
  options.hard = true;
  const DragPreview preview(mesh.positions, topology, region, options);
  const std::array motions{test::bend(), Affine3d(Eigen::Translation3d(0.1, 0.2, 0.3))};
  const Positions positions = test::dragged(preview.response(), motions);
  for (std::size_t h = 0; h < 2; ++h) {
    for (const Index v : region.handles[h]) {
      EXPECT_LT((positions[v] - motions[h] * mesh.positions[v]).norm(), 1e-12) << "handle " << h;
    }
  }
  for (const Index v : region.belt) EXPECT_EQ(positions[v], mesh.positions[v]);
}

TEST(DragPreview, TranslatingAllThatHoldsTranslatesTheRegion) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  const DragPreview preview(mesh.positions, topology, region, {});
  const Affine3d shift(Eigen::Translation3d(1, -2, 3));
  const Positions positions = test::dragged(preview.response(), std::array{shift, shift});
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    EXPECT_LT((positions[i] - shift * mesh.positions[i]).norm(), 1e-9);
  }
}

TEST(DragPreview, FromAPoseItIsThatPoseUntilTheHandleMovesOn) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  const EditRegion region = test::foot_and_head(mesh);
  CpuKernels kernels;
  const DragPreview preview(mesh.positions, topology, region, {});
  const DeformSolver deformer(preview, kernels);
  const std::array motions{test::bend()};
  const Positions settled = deformer.solve(motions).positions;
  const DragState pose = preview.response()->pose_at(settled, handle_motions(motions));
  const DragState same = deformer.response()->pose_at(settled, handle_motions(motions));
  EXPECT_EQ(pose.displacement, same.displacement);

  const auto dragged_by = [&](const Affine3d& motion) {
    return test::dragged(preview.response(), std::array{motion},
                         std::make_shared<const DragState>(pose));
  };
  EXPECT_LT(test::largest_distance(dragged_by(motions[0]), settled), 1e-12);
  const Eigen::Translation3d shift(0.1, 0.0, 0.0);
  const Positions moved = dragged_by(shift * motions[0]);
  EXPECT_NEAR(test::largest_distance(moved, settled), 0.1, 0.01) << "the handle is in front";
}

}  // namespace
}  // namespace lapwing
