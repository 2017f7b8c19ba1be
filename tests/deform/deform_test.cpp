// A deformation as a function of a mesh and a request.
#include "lapwing/deform/deform.h"

#include <array>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/environment.h"
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

// For some of these motions, the Hessian is a poor model of the energy.
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

// A mesh and parameters. Handles without a constraint weight must reach their targets on it.
struct Arrival {
  const char* name;
  Mesh (*make)();
  double detail_length = kDefaultDetailLength;
  HandleOrientation orientation = HandleOrientation::kept;
};

// Returns a grid in which some columns are up to a thousand times as narrow as others.
Mesh uneven_grid() {
  Mesh mesh = grid(16, 16);
  for (Vector3d& p : mesh.positions) p.x() = 0.5 + 4.0 * std::pow(p.x() - 0.5, 3.0);
  return mesh;
}

class AHandle : public ::testing::TestWithParam<Arrival> {
 protected:
  AHandle() : mesh_(GetParam().make()) {
    const Bounds bounds = bounds_of(mesh_.positions);
    const Vector3d centre = 0.5 * (bounds.min + bounds.max);
    request_.roi = {AllVertices{}};
    request_.handles = {{{GeodesicDisk{centre, 0.2}},
                         SimilarityMove{.translate = {0.0, 0.0, kWay}},
                         {},
                         GetParam().orientation}};
    request_.parameters.detail_length = GetParam().detail_length;
  }

  static constexpr double kWay = 0.05;
  Mesh mesh_;
  DeformRequest request_;
};

TEST_P(AHandle, ArrivesWithinAHundredthOfItsWay) {
  const Deformed moved = deform(mesh_, request_);
  EXPECT_TRUE(moved.certificate.settled);
  EXPECT_LT(moved.certificate.handle_error, 0.01 * kWay);
  for (const Index v : moved.region.belt) {
    EXPECT_LT((moved.mesh.positions[v] - mesh_.positions[v]).norm(), 0.01 * kWay) << v;
  }
}

TEST_P(AHandle, WithAWeightIsHeldBackByTheSurface) {
  request_.parameters.constraint_weight = 0.1;
  const double of_all = deform(mesh_, request_).certificate.handle_error;
  EXPECT_GT(of_all, 0.01 * kWay);
  request_.parameters.constraint_weight.reset();
  request_.handles[0].falloff.weight = 0.1;
  EXPECT_GT(deform(mesh_, request_).certificate.handle_error, 0.01 * kWay);
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, AHandle,
    ::testing::Values(Arrival{"OfACoarseGrid", [] { return grid(6, 6); }},
                      Arrival{"OfAFineGrid", [] { return grid(40, 40); }},
                      Arrival{"OfAnUnevenGrid", &uneven_grid},
                      Arrival{"OfAStiffSurface", [] { return grid(6, 6); }, 1e-3},
                      Arrival{"OfASoftSurface", [] { return grid(6, 6); }, 10.0},
                      Arrival{"ThatTurnsFreely", [] { return grid(20, 20); }, kDefaultDetailLength,
                              HandleOrientation::free}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(RimsOfHoles, ThatHoldTheSurfaceAreNamedInANote) {
  const Mesh tube = cylinder(12, 41, 0.5, 20.0);
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.handles = {
      {{ListedVertices{{240, 241, 242}}}, SimilarityMove{.translate = {0.1, 0.0, 0.0}}}};
  EXPECT_THAT(
      deform(tube, request).notes,
      ::testing::Contains(HasSubstr("the belt is those of the largest, at vertices 0, 480. To "
                                    "let them move along, choose a belt")));
  request.handles.push_back({{ListedVertices{{0, 1, 2, 3}}}, SimilarityMove{}});
  EXPECT_THAT(deform(tube, request).notes, IsEmpty());
}

TEST(Hubs, ThatMakeTheMatrixTooLargeAreNamed) {
  constexpr Index kCorners = 2000;
  Mesh fan;
  fan.positions.emplace_back(0.0, 0.0, 0.1);
  for (Index k = 0; k < kCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kCorners;
    fan.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    fan.add_face(std::array<Index, 3>{0, k + 1, (k + 1) % kCorners + 1});
  }
  DeformRequest request;
  request.roi = {AllVertices{}};
  request.handles = {{{ListedVertices{{0}}}, SimilarityMove{.translate = {0.0, 0.0, 0.1}}}};
  const test::Environment little(kMemoryVariable, "20000000");
  EXPECT_THAT(error_message<SolverError>([&] { deform(fan, request); }),
              AllOf(HasSubstr("in which vertex 0 has 2000 neighbours, needs 25 MB of memory"),
                    HasSubstr("remesh the largest polygons, or keep the region away from them")));
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
  first.parameters.constraint_weight = 1e-3;  // too soft for the handle to reach its target
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
