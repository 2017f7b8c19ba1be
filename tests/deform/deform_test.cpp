// A deformation as a function of a mesh and a request.
#include "lapwing/deform/deform.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class DeformInMemory : public ::testing::Test {
 protected:
  // The head of the tube moved, its foot held.
  DeformRequest request(const Vector3d& translate, double degrees) const {
    SimilarityMove move;
    move.translate = translate;
    move.rotate = {Vector3d::UnitZ(), degrees};
    return test::moved_head(region_, move);
  }

  const Mesh mesh_ = test::bumpy_tube();
  const EditRegion region_ = test::foot_and_head(mesh_);
};

TEST_F(DeformInMemory, IsWhatADeformerSolvesFor) {
  const Vector3d aside(0.5, 0.0, 0.2);
  const Deformed deformed = deform(mesh_, request(aside, 0.0));
  CpuKernels kernels;
  const DeformSolver deformer(mesh_.positions, mesh_.topology(), region_, {}, kernels);
  const Eigen::Affine3d move(Eigen::Translation3d{aside});
  EXPECT_EQ(deformed.mesh.positions, deformer.solve(std::array{move}).positions);
  EXPECT_EQ(deformed.mesh.face_vertices(), mesh_.face_vertices());
  EXPECT_EQ(deformed.region.roi, region_.roi);
  EXPECT_EQ(deformed.region.handles, region_.handles);
  EXPECT_EQ(deformed.region.free_count(), deformer.region().free_count());
  EXPECT_TRUE(deformed.certificate.settled);
  EXPECT_THAT(deformed.warnings, IsEmpty());
}

TEST_F(DeformInMemory, AWorkspaceServesOneRequestAfterAnother) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  const DeformRequest there = request({0.5, 0.0, 0.0}, 0.0);
  const DeformRequest on = request({0.0, 0.3, 0.0}, 20.0);
  const Mesh once = deform(mesh_, there, kernels, workspace).mesh;
  const Mesh twice = deform(once, on, kernels, workspace).mesh;
  EXPECT_EQ(twice.positions, deform(once, on).mesh.positions);
}

// Motions under which settling goes every way there is: by the tangent, and where that cannot be
// had.
TEST_F(DeformInMemory, WhatAWorkspaceSolvedBeforeMakesNoDifferenceToTheBits) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  for (int round = 0; round < 2; ++round) {
    for (const DeformRequest& each :
         {request({0.5, 0.0, 0.0}, 0.0), request({0.0, 0.0, -4.0}, 10.0),
          request({0.0, 0.0, -2.0}, 170.0), request({0.0, 0.3, 0.0}, 20.0),
          request(Vector3d::Zero(), 0.0), request({2.0, 0.0, -9.0}, 175.0)}) {
      EXPECT_TRUE(same_bits(deform(mesh_, each, kernels, workspace).mesh.positions,
                            deform(mesh_, each).mesh.positions));
    }
  }
}

TEST_F(DeformInMemory, OnlyTheFirstOfTwoThatMoveDifferentlyPrepares) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  const auto stages = [&](const DeformRequest& each) {
    return deform(mesh_, each, kernels, workspace).timings.stages().size();
  };
  EXPECT_GT(stages(request({0.5, 0.0, 0.0}, 0.0)), 2U);
  EXPECT_EQ(stages(request({0.0, 0.3, 0.0}, 20.0)), 2U) << "region and solve";
}

TEST_F(DeformInMemory, MovesARegionOfOneVertex) {
  DeformRequest one;
  one.roi = {ListedVertices{{130}}};
  one.belt = RegionSpec{ListedVertices{}};
  one.handles = {{{ListedVertices{{130}}}, SimilarityMove{.translate = {0.1, 0.0, 0.0}}}};
  const Positions moved = deform(mesh_, one).mesh.positions;
  EXPECT_GT(moved[130].x() - mesh_.positions[130].x(), 0.01);
  EXPECT_EQ(moved[131], mesh_.positions[131]);
}

TEST_F(DeformInMemory, SaysWhatToChangeWithoutAFile) {
  DeformRequest wound = request(Vector3d::Zero(), 200.0);
  wound.parameters.settle.reset();
  EXPECT_THAT(deform(mesh_, wound).warnings,
              ::testing::Contains(StartsWith("deform: handle 1 turns by 200 degrees")));
  wound.parameters.commit_every = 100.0;
  EXPECT_EQ(deform(mesh_, wound).commits, 2U);
  wound.parameters.commit_every = 0.1;
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, wound); }),
              AllOf(StartsWith("deform: a handle turns by 200 degrees"),
                    HasSubstr("more than 1000 commits")));
  DeformRequest beyond = request(Vector3d::Zero(), 0.0);
  beyond.handles[0].region = {ListedVertices{{static_cast<Index>(mesh_.vertex_count())}}};
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, beyond); }),
              HasSubstr(std::to_string(mesh_.vertex_count())));
}

TEST_F(DeformInMemory, TheRequestsPlaceIsInMessagesAndNoPartOfItsValue) {
  DeformRequest first = request(Vector3d::Zero(), 200.0);
  DeformRequest second = first;
  second.where = "step 2";
  EXPECT_EQ(first, second);
  EXPECT_THAT(deform(mesh_, second).warnings,
              AllOf(Not(IsEmpty()), ::testing::Each(StartsWith("step 2: "))));
  second.parameters.commit_every = 0.1;
  EXPECT_NE(first, second);
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, second); }),
              StartsWith("step 2: a handle turns by"));
}

}  // namespace
}  // namespace lapwing
