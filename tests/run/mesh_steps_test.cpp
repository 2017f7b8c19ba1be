#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/doctor/holes.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/run/run_step.h"

// Steps that change the triangles of a mesh and deform no region.
namespace lapwing {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

// Runs the steps on a tube whose vertices moved by (1, 0, 0) since the mesh was read.
RunResult after(const std::vector<Step>& steps) {
  RunResult result;
  result.mesh = cylinder(12, 9, 1.0, 4.0);
  result.original = result.mesh.positions;
  for (Eigen::Vector3d& p : result.mesh.positions) p.x() += 1.0;
  CpuKernels kernels;
  const Progress progress;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    result.report.steps.push_back(
        run_step(steps[k], {k + 1, std::filesystem::path(), kernels, progress, result, {}}));
  }
  return result;
}

class MeshStep : public ::testing::TestWithParam<Step> {};

TEST_P(MeshStep, KeepsTheFirstPositionOfEachVertex) {
  const RunResult result = after({GetParam()});
  ASSERT_EQ(result.original.size(), result.mesh.vertex_count());
  EXPECT_NE(result.mesh.face_count(), cylinder(12, 9, 1.0, 4.0).face_count());
  EXPECT_TRUE((result.mesh.positions[0] - result.original[0]).isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_EQ(result.report.steps[0].op, operation_of(GetParam()).name);
  EXPECT_THAT(result.report.warnings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(
    RunStep, MeshStep,
    ::testing::Values(Step(RemeshRequest{.region = {AllVertices{}}, .scale = 0.5}),
                      Step(DecimateRequest{}), Step(SubdivideRequest{}), Step(FillRequest{})));

TEST(FillStep, FillsOnlyHolesInItsRegion) {
  const RunResult one = after({FillRequest{.region = {ListedVertices{{3}}}}});
  EXPECT_THAT(find_holes(one.mesh), SizeIs(1));
  EXPECT_EQ(find_holes(one.mesh)[0].rim.front(), 96U);
  const RunResult none = after({FillRequest{.largest = 3}});
  EXPECT_THAT(find_holes(none.mesh), SizeIs(2));
  EXPECT_EQ(none.original.size(), none.mesh.vertex_count());
}

TEST(FillStep, OtherStepsFollow) {
  const RunResult result = after(
      {FillRequest{}, RemeshRequest{.region = {AllVertices{}}}, DecimateRequest{.share = 0.3}});
  EXPECT_THAT(find_holes(result.mesh), IsEmpty());
  EXPECT_EQ(result.original.size(), result.mesh.vertex_count());
}

}  // namespace
}  // namespace lapwing
