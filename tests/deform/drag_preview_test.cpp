#include "lapwing/deform/drag_preview.h"

#include <gtest/gtest.h>

#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/handle_motion.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/dragged.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

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
