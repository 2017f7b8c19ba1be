#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/limits.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/drag.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/cancel_everywhere.h"
#include "support/environment.h"
#include "support/error_message.h"
#include "support/linear_options.h"

// Deformations that are cancelled, and those for which there is no memory.
namespace lapwing::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class CancelDeform : public ::testing::Test {
 protected:
  CancelDeform() { request_.parameters.settle.emplace().max_iterations = 8; }

  const Mesh mesh_ = bumpy_tube();
  CpuKernels kernels_;
  DeformRequest request_ = moved_head(foot_and_head(mesh_),
                                      SimilarityMove{.translate = Eigen::Vector3d(0.5, 0.2, -0.3)});
};

TEST_F(CancelDeform, AtEveryPointLeavesTheMeshAsItWas) {
  const Positions whole = deform(mesh_, request_).mesh.positions;
  Positions done;
  EXPECT_GT(cancel_everywhere([&](const Progress& progress) {
              DeformWorkspace workspace;
              done = deform(mesh_, request_, kernels_, workspace, progress).mesh.positions;
            }),
            50U);
  EXPECT_EQ(mesh_.positions, bumpy_tube().positions);
  EXPECT_EQ(done, whole);
}

// An edit that follows a cancelled one reuses what was prepared, or prepares it again.
TEST_F(CancelDeform, AtEveryPointLeavesAWorkspaceThatGoesOnRight) {
  const Positions whole = deform(mesh_, request_).mesh.positions;
  DeformWorkspace workspace;
  Positions done;
  cancel_everywhere([&](const Progress& progress) {
    done = deform(mesh_, request_, kernels_, workspace, progress).mesh.positions;
  });
  EXPECT_EQ(done, whole);
}

TEST_F(CancelDeform, InAllOtherFormsToo) {
  DeformRequest linear = request_;
  linear.parameters.settle.reset();
  linear.parameters.hard = true;
  DeformRequest without_memory = request_;
  without_memory.parameters.memory_limit_bytes = 1000;
  DeformRequest in_parts = request_;
  in_parts.handles[0].move = SimilarityMove{.rotate = {{0.0, 0.0, 1.0}, 40.0}};
  in_parts.parameters.commit_every = 20.0;
  for (const DeformRequest& request : {linear, without_memory, in_parts}) {
    const Positions whole = deform(mesh_, request).mesh.positions;
    Positions done;
    cancel_everywhere([&](const Progress& progress) {
      DeformWorkspace workspace;
      done = deform(mesh_, request, kernels_, workspace, progress).mesh.positions;
    });
    EXPECT_EQ(done, whole);
  }
}

TEST_F(CancelDeform, WhileColumnsAreMadeLeavesADeformerThatMakesThem) {
  const DeformSolver fresh(mesh_.positions, mesh_.topology(), foot_and_head(mesh_), {}, kernels_);
  const DeformSolver deformer(mesh_.positions, mesh_.topology(), foot_and_head(mesh_), {},
                              kernels_);
  cancel_everywhere([&](const Progress& progress) { deformer.response(progress); });
  EXPECT_TRUE(std::ranges::equal(deformer.response()->columns().numbers,
                                 fresh.response()->columns().numbers));
}

TEST_F(CancelDeform, WithoutTheMemoryForColumnsOrSettlingIsRefusedByNumber) {
  const DeformSolver deformer(mesh_.positions, mesh_.topology(), foot_and_head(mesh_),
                              linear_options(), kernels_);
  {
    const Environment little(kMemoryVariable, "20000");
    EXPECT_THAT(error_message<SolverError>([&] { deformer.response(); }),
                AllOf(StartsWith("the response of 240 vertices to 1 handles needs 1 MB"),
                      HasSubstr("set LAPWING_MOST_MEMORY to more bytes")));
    EXPECT_THAT(error_message<SolverError>([&] { deform(mesh_, request_); }),
                AllOf(HasSubstr("settling 240 vertices needs "),
                      HasSubstr(" MB of memory, more than the limit of 1 MB"),
                      HasSubstr("choose a smaller region")));
  }
  EXPECT_NO_THROW(deformer.response());
  EXPECT_NO_THROW(deform(mesh_, request_));
}

}  // namespace
}  // namespace lapwing::test
