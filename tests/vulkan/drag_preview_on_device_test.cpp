#include <array>
#include <thread>

#include "kernels/moved_mesh.h"
#include "kernels/twins.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "support/bent_tube.h"
#include "support/linear_options.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

class DragPreviewOnDevice : public test::KernelTest {
 protected:
  Mesh mesh = test::bumpy_tube();
  Topology topology = mesh.topology();
  double diagonal = bounds_of(mesh.positions).diagonal();
  std::array<Affine3d, 1> bend{test::bend()};

  DragPreview preview(const DeformOptions& options = {}) {
    return {mesh.positions, topology, test::foot_and_head(mesh), options};
  }
  Positions shown(const std::shared_ptr<const DragResponse>& response,
                  std::span<const Affine3d> motions) {
    test::MovedMesh moved(context, mesh.positions, topology, response->columns());
    moved.blend(Drag(response).parameters(motions));
    return moved.positions();
  }
};

TEST_P(DragPreviewOnDevice, StillHandleLeavesTheSurfaceAtRest) {
  const std::array still{Affine3d::Identity()};
  EXPECT_LT(test::largest_distance(shown(preview().response(), still), mesh.positions),
            surface_tolerance() * diagonal);
}

// Free vertices follow (L'Om L + K) u = 0.
TEST_P(DragPreviewOnDevice, KeepsLaplacianCoordinatesAsTheyAre) {
  const Positions positions = shown(preview().response(), bend);
  std::vector<Vector3d> u(positions.size());
  for (std::size_t v = 0; v < u.size(); ++v) u[v] = positions[v] - mesh.positions[v];
  const EditRegion region = test::foot_and_head(mesh);
  const Constraints free = constraints_of(region, topology, 1.0, true);
  const SystemPattern pattern(topology, region.roi, free.unknowns);
  const DeformOptions options;
  LaplacianSystem laplacian(topology, region.roi, free.unknowns, pattern);
  laplacian.assemble(mesh.positions, {options.weights, options.detail_length});
  std::vector<double> residual(3 * free.unknowns.size());
  laplacian.multiply(u, residual);
  for (const double r : residual) EXPECT_LT(std::abs(r), 100.0 * surface_tolerance() * diagonal);
}

TEST_P(DragPreviewOnDevice, HandleGoesAboutWhereItIsDragged) {
  DeformOptions options;
  for (const bool hard : {false, true}) {
    options.hard = hard;
    const DragPreview dragged = preview(options);
    const Positions positions = shown(dragged.response(), bend);
    for (const Index v : dragged.region().handles[0]) {
      EXPECT_LT((positions[v] - bend[0] * mesh.positions[v]).norm(),
                (hard ? surface_tolerance() : 0.025) * diagonal);
    }
  }
}

TEST_P(DragPreviewOnDevice, DeformerMadeFromItIsTheOneMadeAlone) {
  const DeformOptions options;
  const DragPreview first = preview(options);
  const DeformSolver after(first, *kernels);
  const DeformSolver alone(mesh.positions, topology, test::foot_and_head(mesh), options, *kernels);
  EXPECT_EQ(after.solve(bend).positions, alone.solve(bend).positions);
}

TEST_P(DragPreviewOnDevice, FollowsTheHandleWhileAnotherThreadPreparesTheExactOne) {
  const DragPreview first = preview(test::linear_options());
  std::unique_ptr<Kernels> own = std::make_unique<CpuKernels>();
  if (context) own = std::make_unique<VulkanKernels>(context, GetParam().precision);
  std::unique_ptr<DeformSolver> exact;
  std::thread preparing([&] { exact = std::make_unique<DeformSolver>(first, *own); });
  test::MovedMesh moved(context, mesh.positions, topology, first.response()->columns());
  Drag drag(first.response());
  for (int frame = 0; frame < 50; ++frame) moved.blend(drag.parameters(bend));
  preparing.join();
  const Positions expected = exact->solve(bend).positions;
  EXPECT_LT(test::largest_distance(shown(exact->response(), bend), expected),
            surface_tolerance() * diagonal);
  EXPECT_LT(test::largest_distance(moved.positions(), expected), 0.3 * diagonal);
}

LAPWING_ON_ALL_TWINS(DragPreviewOnDevice);

}  // namespace
}  // namespace lapwing
