// Settled drags of real meshes that a coarse surface takes along.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "lapwing/deform/drag_session.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/mesh.h"
#include "support/models.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

// A tenth of the vertices at either end of the longest axis.
EditRegion ends_along(Eigen::Index axis, const Positions& positions) {
  std::vector<Index> order(positions.size());
  std::iota(order.begin(), order.end(), Index{0});
  EditRegion region;
  region.roi = order;
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return positions[a][axis] < positions[b][axis]; });
  const auto count = static_cast<std::ptrdiff_t>(order.size() / 10);
  region.belt = make_vertex_set({order.begin(), order.begin() + count});
  region.handles = {make_vertex_set({order.end() - count, order.end()})};
  return region;
}

// One end aside, by so many iterations of the surface itself in each frame: how far it is at most
// from what it would settle to, as a share of the diagonal.
double off_while_lifted(const Mesh& mesh, int iterations_a_frame) {
  constexpr int kFrames = 15;  // of the 30 that the whole way takes
  const Bounds bounds = bounds_of(mesh.positions);
  Eigen::Index axis = 0;
  (bounds.max - bounds.min).maxCoeff(&axis);
  CpuKernels kernels;
  const EditRegion region = ends_along(axis, mesh.positions);
  const auto solver = [&] {
    return std::make_shared<const DeformSolver>(mesh.positions, mesh.topology(), region,
                                                DeformOptions(), kernels);
  };
  DragSession drag(solver());
  DragSession reference(solver());
  drag.wait_until_prepared();
  const auto lifted = [&](int frame) {
    const double share = 0.5 - 0.5 * std::cos(std::numbers::pi * frame / (2 * kFrames));
    Affine3d motion = Affine3d::Identity();
    motion.translate(0.1 * share * bounds.diagonal() * Vector3d::Unit((axis + 1) % 3));
    return std::array{motion};
  };
  const DragState& pose = drag.state();
  double most = 0.0;
  for (int frame = 0; frame <= kFrames; ++frame) {
    int asks = 1 + iterations_a_frame;
    drag.step(lifted(frame), [&asks](double) { return asks-- > 0; });
    if (frame != 2 * kFrames / 3 && frame != kFrames) continue;
    DragState start = pose;
    start.last_result = {};
    reference.begin(std::move(start));
    const DragState& settled = reference.state();
    for (int k = 0; k < 5 && !settled.last_result.settled; ++k) reference.step(lifted(frame));
    EXPECT_TRUE(settled.last_result.settled);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      most = std::max(most, (settled.displacement[v] - pose.displacement[v]).norm());
    }
  }
  return most / bounds.diagonal();
}

// What a few iterations leave rough must not mislead the coarse surface.
TEST(FollowOnModels, AFewIterationsAFrameLeaveItWithinAPercent) {
  LAPWING_NEEDS_MODELS(files, "cgal");
  for (const char* name : {"camel.off", "lion-head.off", "mannequin-devil.off"}) {
    const Mesh mesh = read_mesh(test::models_folder() / "cgal" / "meshes" / name);
    for (const int iterations : {1, 2}) {
      EXPECT_LT(off_while_lifted(mesh, iterations), 0.01) << name << ", " << iterations;
    }
  }
}

}  // namespace
}  // namespace lapwing
