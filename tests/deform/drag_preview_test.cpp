#include "lapwing/deform/drag_preview.h"

#include <gtest/gtest.h>

#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

TEST(DragPreview, HardHandlesGoWhereTheyShouldEachByItsOwnMotion) {
  const Mesh mesh = test::bumpy_tube();
  const Topology topology = build_topology(mesh);
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back({118, 119, 120, 121});
  DeformOptions options;
  options.hard = true;
  CpuKernels kernels;
  DragPreview preview(mesh.positions, topology, region, options, kernels);
  const std::array motions{test::bend(), Affine3d(Eigen::Translation3d(0.1, 0.2, 0.3))};
  preview.drag(motions);
  const Positions positions = preview.surface().positions();
  for (std::size_t h = 0; h < 2; ++h) {
    for (const Index v : region.handles[h]) {
      EXPECT_LT((positions[v] - motions[h] * mesh.positions[v]).norm(), 1e-12) << "handle " << h;
    }
  }
  for (const Index v : region.belt) EXPECT_EQ(positions[v], mesh.positions[v]);
}

TEST(DragPreview, TranslatingAllThatHoldsTranslatesTheRegion) {
  const Mesh mesh = test::bumpy_tube();
  const Topology topology = build_topology(mesh);
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  CpuKernels kernels;
  DragPreview preview(mesh.positions, topology, region, {}, kernels);
  const Affine3d shift(Eigen::Translation3d(1, -2, 3));
  preview.drag(std::array{shift, shift});
  const Positions positions = preview.surface().positions();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    EXPECT_LT((positions[i] - shift * mesh.positions[i]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace lapwing
