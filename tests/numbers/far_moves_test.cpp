// Tests moves of handles and targets that overflow doubles, and the smallest and largest weights.
#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/deform/drag_session.h"
#include "lapwing/deform/prepared_deform.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class NumbersOfAnEdit : public ::testing::Test {
 protected:
  const Mesh mesh_ = bumpy_tube();
  const EditRegion region_ = foot_and_head(mesh_);
  const double diagonal_ = bounds_of(mesh_.positions).diagonal();

  DeformRequest bent() const {
    return moved_head(
        region_, SimilarityMove{.translate = {0.5, 0.0, -0.3}, .rotate = {{0.0, 1.0, 0.0}, 35.0}});
  }
  static Move by(double distance) { return SimilarityMove{.translate = {distance, 0.0, 0.0}}; }
};

TEST_F(NumbersOfAnEdit, FarMovesAreRefusedOnEveryWay) {
  const auto refusal = AllOf(HasSubstr("handle 0 moves "), HasSubstr("over 1e+07 times"));
  for (const double distance : {1e8, 1e160, 1e308}) {
    EXPECT_THAT(
        error_message<InputError>([&] { deform(mesh_, moved_head(region_, by(distance))); }),
        refusal);
  }
  PreparedDeform prepared(mesh_, bent());
  EXPECT_THAT(error_message<InputError>([&] { prepared.solve(std::array{by(1e160)}); }), refusal);
  CpuKernels kernels;
  const auto solver = std::make_shared<const DeformSolver>(mesh_.positions, mesh_.topology(),
                                                           region_, DeformOptions(), kernels);
  const std::array far{Eigen::Affine3d(Eigen::Translation3d(1e160, 0.0, 0.0))};
  DragSession drag(solver);
  EXPECT_THAT(error_message<InputError>([&] { solver->solve(far); }), refusal);
  EXPECT_THAT(error_message<InputError>([&] { drag.step(far); }), refusal);
  const std::array huge{Eigen::Affine3d(Eigen::Scaling(1e160))};
  EXPECT_THAT(error_message<InputError>([&] { solver->solve(huge); }), refusal);
}

TEST_F(NumbersOfAnEdit, FarTargetsAreRefused) {
  DeformRequest request = bent();
  request.targets.rows = {{Index{120}, {1e9, 0.0, 0.0}}};
  EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request); }),
              HasSubstr("target 0 moves "));
}

TEST_F(NumbersOfAnEdit, NearlyAsFarTheShapeIsKept) {
  DeformRequest request = moved_head(region_, by(5e6));
  request.belt = RegionSpec{ListedVertices{}};
  const Positions moved = deform(mesh_, request).mesh.positions;
  double off = 0.0;
  for (std::size_t v = 0; v < moved.size(); ++v) {
    const Eigen::Vector3d back = moved[v] - Eigen::Vector3d(5e6, 0.0, 0.0);
    off = std::max(off, (back - mesh_.positions[v]).norm());
  }
  EXPECT_LT(off, 1e-6 * diagonal_);
}

TEST_F(NumbersOfAnEdit, WeightsBeyondTheirRangeAreRefusedByName) {
  for (const double weight : {0.0, -1.0, 1e-20, 1e13, 1e300}) {
    DeformRequest request = bent();
    request.parameters.constraint_weight = weight;
    EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request); }),
                HasSubstr("the constraint weight must be a weight from 0.000001 to"));
    request = bent();
    request.handles[0].falloff.weight = weight;
    EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request); }),
                HasSubstr("expected a weight from 0.000001 to"));
    request = bent();
    request.targets.rows = {{Index{120}, {1.0, 0.0, 1.0}, weight}};
    EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request); }),
                HasSubstr("expected a weight from 0.000001 to"));
  }
}

TEST_F(NumbersOfAnEdit, DetailLengthsBeyondTheirRangeAreRefusedByName) {
  for (const double length : {0.0, 1e-12, 1e6, 1e200}) {
    DeformRequest request = bent();
    request.parameters.detail_length = length;
    EXPECT_THAT(error_message<InputError>([&] { deform(mesh_, request); }),
                HasSubstr("the detail length must be a number from 1e-06 to 1000"));
  }
}

TEST_F(NumbersOfAnEdit, FirmestWeightsHoldAsHardOnesDo) {
  DeformRequest request = bent();
  request.parameters.settle->tolerance = 1e-9;
  request.parameters.hard = true;
  const Positions hard = deform(mesh_, request).mesh.positions;
  request.parameters.hard = false;
  request.parameters.constraint_weight = kMaxWeight;
  EXPECT_LT(largest_distance(deform(mesh_, request).mesh.positions, hard), 1e-6 * diagonal_);
  request.handles[0].falloff.weight = kMaxWeight;
  EXPECT_LT(largest_distance(deform(mesh_, request).mesh.positions, hard), 1e-6 * diagonal_);
}

TEST_F(NumbersOfAnEdit, WidestFalloffIsThatOfTheWholeRegion) {
  DeformRequest request = bent();
  request.handles[0].falloff.transition = Transition{1e6 * diagonal_};
  const Positions wide = deform(mesh_, request).mesh.positions;
  request.handles[0].falloff.transition = Transition{1e12 * diagonal_};
  EXPECT_LT(largest_distance(deform(mesh_, request).mesh.positions, wide), 1e-6 * diagonal_);
}

TEST_F(NumbersOfAnEdit, HandlesThatMissTheirPlacesAreWarnedOf) {
  const auto warning = Contains(HasSubstr("a handle misses its place by"));
  DeformRequest request = bent();
  EXPECT_THAT(deform(mesh_, request).warnings, IsEmpty());
  request.parameters.constraint_weight = 1e-3;
  const Deformed missed = deform(mesh_, request);
  EXPECT_GT(missed.certificate.handle_error, 0.01 * diagonal_);
  EXPECT_THAT(missed.warnings, warning);
  PreparedDeform prepared(mesh_, request);
  EXPECT_THAT(prepared.solve(std::array{request.handles[0].move}).warnings, warning);
  request.parameters.commit_every = 20.0;
  EXPECT_THAT(deform(mesh_, request).warnings, warning);
}

}  // namespace
}  // namespace lapwing::test
