// Tests a deformation on each device, from the assembly to the dragged surface.
#include <cstring>

#include "kernels/moved_mesh.h"
#include "kernels/twins.h"
#include "lapwing/deform/deform_solver.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "support/bent_tube.h"
#include "support/linear_options.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

class DeformOnDevice : public test::KernelTest {
 protected:
  Positions deformed(const Mesh& mesh, const Affine3d& motion) {
    const Topology& topology = mesh.topology();
    const DeformSolver deformer(mesh.positions, topology, test::foot_and_head(mesh),
                                test::linear_options(), *kernels);
    return deformer.solve(std::array{motion}).positions;
  }
};

TEST_P(DeformOnDevice, StillHandleGivesTheInputBackBitForBit) {
  const Mesh mesh = test::bumpy_tube();
  const Positions result = deformed(mesh, Affine3d::Identity());
  EXPECT_EQ(std::memcmp(result.data(), mesh.positions.data(), sizeof(Vector3d) * result.size()), 0);
}

TEST_P(DeformOnDevice, TranslatingHandleAndBeltTogetherTranslatesTheRegion) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  EditRegion region = test::foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  const DeformSolver deformer(mesh.positions, topology, region, test::linear_options(), *kernels);
  const Affine3d shift(Eigen::Translation3d(1, -2, 3));
  const Positions result = deformer.solve(std::array{shift, shift}).positions;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    EXPECT_LT((result[i] - shift * mesh.positions[i]).norm(), 1e-6);
  }
}

TEST_P(DeformOnDevice, ResultDoesNotDependOnPlaceOrUnit) {
  const Mesh mesh = test::bumpy_tube();
  const double diagonal = bounds_of(mesh.positions).diagonal();
  const Positions expected = deformed(mesh, test::bend());
  for (const double scale : {1e-3, 1.0, 1e3}) {
    const Affine3d frame =
        Eigen::Translation3d(scale * 1e4 * Vector3d(1, -1, 1)) * Eigen::Scaling(scale);
    Mesh moved = mesh;
    for (Vector3d& p : moved.positions) p = frame * p;
    Positions result = deformed(moved, frame * test::bend() * frame.inverse());
    for (Vector3d& p : result) p = frame.inverse() * p;
    EXPECT_LT(test::largest_distance(result, expected), 1e-6 * diagonal) << "scale " << scale;
  }
}

TEST_P(DeformOnDevice, DraggedSurfaceFollowsTheSolution) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  const DeformSolver deformer(mesh.positions, topology, test::foot_and_head(mesh),
                              test::linear_options(), *kernels);
  const std::array motions{test::bend()};
  const auto response = deformer.response();
  Drag drag(response);
  test::MovedMesh shown(context, mesh.positions, topology, response->columns());
  shown.blend(drag.parameters(motions));
  EXPECT_LT(test::largest_distance(shown.positions(), deformer.solve(motions).positions),
            surface_tolerance() * bounds_of(mesh.positions).diagonal());
}

// Settling to this tolerance needs double precision.
class SettleOnDevice : public DeformOnDevice {};

TEST_P(SettleOnDevice, RingsSettleToTheSameShape) {
  const Mesh mesh = test::bumpy_tube();
  const Topology& topology = mesh.topology();
  const EditRegion region = test::foot_and_head(mesh);
  const Constraints constraints = constraints_of(region, topology, 1.0, false);
  std::vector<Vector3d> wanted(mesh.vertex_count(), Vector3d::Zero());
  for (const Index v : region.handles[0]) {
    wanted[v] = test::bend() * mesh.positions[v] - mesh.positions[v];
  }
  for (const double length : {0.077, 0.5}) {
    StageTimings timings;
    const SystemPattern pattern(topology, region.roi, constraints.unknowns);
    const LaplacianSystem system(mesh.positions, topology, region.roi, constraints, pattern,
                                 {LaplacianWeights::cotangent, length}, timings);
    const auto settled_on = [&](Kernels& on) {
      const SettleOptions options{.tolerance = 1e-9, .max_iterations = 2000};
      Positions u(mesh.vertex_count(), Vector3d::Zero());
      EXPECT_TRUE(EnergyMinimizer(on, system, options).settle({wanted}, u).settled);
      return u;
    };
    CpuKernels cpu;
    EXPECT_LT(test::largest_distance(settled_on(*kernels), settled_on(cpu)),
              1e-9 * bounds_of(mesh.positions).diagonal());
  }
}

LAPWING_ON_ALL_TWINS(DeformOnDevice);
INSTANTIATE_TEST_SUITE_P(Twins, SettleOnDevice, ::testing::Values(test::kTwins[0], test::kTwins[1]),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace lapwing
