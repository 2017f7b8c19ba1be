// The energy has several minima. Tests which minimum the minimizer reaches along a path.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/deform/deform.h"
#include "lapwing/deform/drag_session.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::largest_distance;

HandleMotions shifted(double x, double z) {
  return handle_motions(std::array{Affine3d(Eigen::Translation3d(x, 0.0, z))});
}

HandleMotions tilted(double degrees, double z) {
  return handle_motions(
      std::array{test::turn_and_move(degrees, Vector3d::UnitY(), Vector3d(0.0, 0.0, z))});
}

Mesh thin_tube(int around) {
  Mesh mesh = test::rippled_cylinder(around, 2 * around + 1);
  for (Vector3d& p : mesh.positions) p = p.cwiseProduct(Vector3d(0.3, 0.3, 1.0));
  return mesh;
}

// A thin tube along z that is compressed and buckles to one side.
class APushedTube : public ::testing::TestWithParam<int> {
 protected:
  static constexpr double kPushed = -1.5;

  static std::vector<HandleMotions> way_round(double side) {
    std::vector<HandleMotions> path;
    for (int k = 1; k <= 5; ++k) path.push_back(tilted(side * 15.0 * k, 0.0));
    for (int k = 1; k <= 5; ++k) path.push_back(tilted(side * 75.0, 0.2 * kPushed * k));
    for (int k = 4; k >= 1; --k) path.push_back(tilted(side * 15.0 * k, kPushed));
    return path;
  }
  double side_of(const Positions& positions) const {
    double sum = 0.0;
    for (std::size_t v = 0; v < positions.size(); ++v) {
      sum += positions[v].x() - mesh_.positions[v].x();
    }
    return sum / static_cast<double>(positions.size());
  }

  Mesh mesh_ = thin_tube(GetParam());
  Topology topology_ = mesh_.topology();
  CpuKernels kernels_;
  std::shared_ptr<const DeformSolver> solver_ = std::make_shared<const DeformSolver>(
      mesh_.positions, topology_, test::ends_of_cylinder(mesh_), DeformOptions(), kernels_);
};

TEST_P(APushedTube, GivesWayToTheSideThatItsPathWasOn) {
  const HandleMotions end = shifted(0.0, kPushed);
  const DeformResult left = solver_->solve_along(way_round(-1.0), end);
  const DeformResult right = solver_->solve_along(way_round(1.0), end);
  EXPECT_TRUE(left.certificate.settled);
  EXPECT_TRUE(right.certificate.settled);
  EXPECT_GT(std::abs(side_of(left.positions)), 0.2);
  EXPECT_LT(side_of(left.positions) * side_of(right.positions), 0.0);
}

TEST_P(APushedTube, ThatWasDraggedEndsWhereTheDragWas) {
  const HandleMotions end = shifted(0.0, kPushed);
  for (const double side : {-1.0, 1.0}) {
    const std::vector<HandleMotions> path = way_round(side);
    DragSession drag(solver_);
    drag.wait_until_prepared();  // so that no frame depends on how long that takes
    for (const HandleMotions& frame : path) {
      int left = 6;
      drag.step(frame, [&left](double) { return left-- > 0; });
    }
    const DeformResult kept = solver_->solve_from(drag.state(), end);
    const DeformResult replayed = solver_->solve_along(path, end);
    // The distance to the minimum on the other side is 0.4.
    EXPECT_LT(largest_distance(kept.positions, replayed.positions), 5e-2) << side;
  }
}

TEST_P(APushedTube, ThatHasSettledStaysWhereItIs) {
  const HandleMotions bent = shifted(1.0, -0.5);
  const DeformResult first = solver_->solve(bent);
  const DragState pose = solver_->response()->pose_at(first.positions, bent);
  const DeformResult again = solver_->solve_from(pose, bent);
  EXPECT_LT(largest_distance(first.positions, again.positions), 1e-12);
  EXPECT_EQ(again.certificate.settle_iterations, 0);
}

TEST_P(APushedTube, EndsAtTheSameByPathsThatMakeNoDifference) {
  const HandleMotions end = shifted(1.0, 0.5);
  const std::vector<HandleMotions> path{shifted(0.3, 0.3), shifted(0.9, 0.2)};
  EXPECT_LT(
      largest_distance(solver_->solve_along(path, end).positions, solver_->solve(end).positions),
      1e-3);
}

INSTANTIATE_TEST_SUITE_P(Sizes, APushedTube, ::testing::Values(30, 60));

TEST(Paths, OfARequestLeadToWhatTheDeformerMakesOfThem) {
  const Mesh mesh = test::bumpy_tube();
  const EditRegion region = test::foot_and_head(mesh);
  const auto move = [](double x) { return Move(SimilarityMove{.translate = {x, 0.0, 0.0}}); };
  DeformRequest request = test::moved_head(region, move(0.6));
  request.handles[0].path = {move(0.2), move(0.4)};
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, mesh.topology(), region, {}, kernels);
  const Positions expected =
      deformer.solve_along(std::vector{shifted(0.2, 0.0), shifted(0.4, 0.0)}, shifted(0.6, 0.0))
          .positions;
  EXPECT_LT(largest_distance(deform(mesh, request).mesh.positions, expected), 1e-12);
}

}  // namespace
}  // namespace lapwing
