#include "lapwing/deform/deform_solver.h"

#include <algorithm>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/dragged.h"
#include "support/error_message.h"
#include "support/linear_options.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

using test::bend;
using test::bumpy_tube;
using test::dragged;
using test::foot_and_head;
using test::largest_distance;

class DeformSolverTest : public ::testing::Test {
 protected:
  DeformSolver solver(const DeformOptions& options = {}, const Progress& progress = {}) {
    return {mesh_.positions, mesh_.topology(), region_, options, kernels_, progress};
  }
  DeformResult solved(const DeformOptions& options, const Affine3d& motion = bend()) {
    return solver(options).solve(std::vector(region_.handles.size(), motion));
  }
  // Turns the belt into a second handle, so that the region has no belt.
  void make_belt_a_handle() {
    region_.handles.push_back(std::move(region_.belt));
    region_.belt.clear();
  }

  Mesh mesh_ = bumpy_tube();
  EditRegion region_ = foot_and_head(mesh_);
  CpuKernels kernels_;
};

DeformOptions tightly_settled() {
  DeformOptions options;
  options.settle.emplace().tolerance = 1e-8;
  options.settle->max_iterations = 1000;
  return options;
}

DeformOptions hard_settled() {
  DeformOptions options = tightly_settled();
  options.hard = true;
  return options;
}

class DeformerOptions : public DeformSolverTest,
                        public ::testing::WithParamInterface<DeformOptions> {};

TEST_P(DeformerOptions, StillHandleGivesTheInputBackBitForBit) {
  mesh_.positions[5].x() = -0.0;
  EXPECT_TRUE(same_bits(solved(GetParam(), Affine3d::Identity()).positions, mesh_.positions));
}

TEST_P(DeformerOptions, TranslatingHandleAndBeltTogetherTranslatesTheRegion) {
  make_belt_a_handle();
  const Affine3d shift(Eigen::Translation3d(1, -2, 3));
  const DeformResult result = solved(GetParam(), shift);
  for (std::size_t i = 0; i < mesh_.vertex_count(); ++i) {
    EXPECT_LT((result.positions[i] - shift * mesh_.positions[i]).norm(), 1e-9);
  }
  EXPECT_LT(result.certificate.handle_error, 1e-9);
  EXPECT_NEAR(result.certificate.smallest_scale, 1.0, 1e-9);
}

TEST_P(DeformerOptions, ResultDoesNotDependOnPlaceUnitOrOrientation) {
  const Mesh mesh = mesh_;
  const double diagonal = bounds_of(mesh.positions).diagonal();
  const Positions expected = solved(GetParam()).positions;
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double offset : {0.0, 1e4}) {
      const Affine3d frame = Eigen::Translation3d(scale * Vector3d(offset, -offset, offset)) *
                             Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()) *
                             Eigen::Scaling(scale);
      mesh_ = mesh;
      for (Vector3d& p : mesh_.positions) p = frame * p;
      Positions result = solved(GetParam(), frame * bend() * frame.inverse()).positions;
      for (Vector3d& p : result) p = frame.inverse() * p;
      EXPECT_LT(largest_distance(result, expected), 1e-6 * diagonal)
          << "scale " << scale << ", offset " << offset;
    }
  }
}

TEST_P(DeformerOptions, HardHandlesReachTheirPlaces) {
  const Certificate certificate = solved(GetParam()).certificate;
  if (GetParam().hard) {
    EXPECT_LT(certificate.handle_error, 1e-14);
  } else {
    EXPECT_GT(certificate.handle_error, 0.0);
  }
}

TEST_P(DeformerOptions, LinearSolutionIsThatOfTheNormalEquationsAndOfADrag) {
  if (GetParam().settle) return;
  const DeformSolver deformer = solver(GetParam());
  const std::array motions{bend()};
  const DeformResult result = deformer.solve(motions);
  EXPECT_LT(result.certificate.relative_residual, 1e-9);
  EXPECT_LT(largest_distance(dragged(deformer.response(), motions), result.positions), 1e-9);
}

TEST_P(DeformerOptions, RunsGiveTheSameBits) {
  EXPECT_TRUE(same_bits(solved(GetParam()).positions, solved(GetParam()).positions));
}

DeformOptions with(LaplacianWeights weights, bool hard,
                   LinearResponse response = LinearResponse::rsi) {
  DeformOptions options = test::linear_options();
  options.response = response;
  options.weights = weights;
  options.hard = hard;
  return options;
}

INSTANTIATE_TEST_SUITE_P(
    All, DeformerOptions,
    ::testing::Values(with(LaplacianWeights::uniform, false), with(LaplacianWeights::uniform, true),
                      with(LaplacianWeights::cotangent, false),
                      with(LaplacianWeights::cotangent, true),
                      with(LaplacianWeights::cotangent, false, LinearResponse::tangent),
                      with(LaplacianWeights::uniform, true, LinearResponse::tangent),
                      tightly_settled(), hard_settled()),
    [](const auto& test) {
      const DeformOptions& o = test.param;
      return std::string(o.settle                            ? "Settled"
                         : o.response == LinearResponse::rsi ? "Rsi"
                                                             : "Tangent") +
             std::string(o.weights == LaplacianWeights::uniform ? "Uniform" : "Cotangent") +
             (o.hard ? "Hard" : "Soft");
    });

TEST_F(DeformSolverTest, SettlingKeepsDetailThroughALargeTurn) {
  const Affine3d turn(Eigen::AngleAxisd(2.0, Vector3d::UnitZ()));
  const Certificate linear = solved(test::linear_options(), turn).certificate;
  const DeformOptions options;
  const Certificate settled = solved(options, turn).certificate;
  EXPECT_LT(2.0 * settled.detail_error, linear.detail_error);
  EXPECT_LT(settled.edge_stretch, linear.edge_stretch);
  EXPECT_TRUE(settled.settled);
  EXPECT_GT(settled.settle_iterations, 1);
  EXPECT_LE(settled.settle_last_step, options.settle->tolerance);
  EXPECT_EQ(linear.settle_iterations, 0);
}

TEST_F(DeformSolverTest, SettlingThatRunsOutOfIterationsSaysSo) {
  DeformOptions options;
  options.settle.emplace().max_iterations = 2;
  const Certificate certificate = solved(options).certificate;
  EXPECT_FALSE(certificate.settled);
  EXPECT_EQ(certificate.settle_iterations, 2);
  EXPECT_GT(certificate.settle_last_step, options.settle->tolerance);
}

TEST_F(DeformSolverTest, VerticesOutsideTheRegionKeepTheirBits) {
  const Mesh mesh = icosphere(3);
  const Topology& topology = mesh.topology();
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() < 0.2) continue;
    region.roi.push_back(v);
    if (mesh.positions[v].z() < 0.35) region.belt.push_back(v);
    if (mesh.positions[v].z() > 0.95) region.handles[0].push_back(v);
  }
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, region, {}, kernels);
  const auto result = deformer.solve(std::array{Affine3d(Eigen::Translation3d(0, 0, 0.5))});
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions[v].z() < 0.2) {
      EXPECT_EQ(result.positions[v], mesh.positions[v]);
    }
  }
  EXPECT_GT(result.positions[region.handles[0][0]].z(), mesh.positions[region.handles[0][0]].z());
}

TEST_F(DeformSolverTest, LooseVertexStaysUnlessAHandleTakesIt) {
  const auto loose = static_cast<Index>(mesh_.vertex_count());
  mesh_.positions.emplace_back(7, 7, 7);
  mesh_.positions.emplace_back(8, 8, 8);
  region_.roi.insert(region_.roi.end(), {loose, loose + 1});
  region_.handles[0].push_back(loose + 1);
  const Affine3d shift(Eigen::Translation3d(0, 0, 1));
  for (const bool hard : {false, true}) {
    const DeformResult result = solved(with(LaplacianWeights::uniform, hard), shift);
    EXPECT_EQ(result.positions[loose], mesh_.positions[loose]);
    EXPECT_LT((result.positions[loose + 1] - Vector3d(8, 8, 9)).norm(), 1e-12);
  }
}

TEST_F(DeformSolverTest, StrongerConstraintsHoldTheHandleBetter) {
  double previous = std::numeric_limits<double>::infinity();
  for (const double weight : {0.3, 1.0, 10.0}) {
    DeformOptions options;
    options.constraint_weight = weight;
    const double error = solved(options).certificate.handle_error;
    EXPECT_LT(error, previous);
    previous = error;
  }
}

TEST_F(DeformSolverTest, WithoutMemoryForTheExactSystemItDragsLikeThePreviewAndStillSettles) {
  DeformOptions options = tightly_settled();
  const DeformSolver exact = solver(options);
  EXPECT_EQ(exact.response()->why_not_exact(), "");
  options.memory_limit_bytes = 1000;
  const DeformSolver deformer = solver(options);
  EXPECT_THAT(deformer.response()->why_not_exact(),
              ::testing::AllOf(::testing::HasSubstr("240 vertices needs"),
                               ::testing::EndsWith("limit of 1 MB")));

  const std::array motions{bend()};
  const DragPreview preview(mesh_.positions, mesh_.topology(), region_, options);
  EXPECT_LT(
      largest_distance(dragged(deformer.response(), motions), dragged(preview.response(), motions)),
      1e-12);

  for (const Affine3d& motion : {bend(), Affine3d(Eigen::Translation3d(0.6, 0.0, 0.0))}) {
    const DeformResult result = deformer.solve(std::array{motion});
    EXPECT_TRUE(result.certificate.settled);
    EXPECT_TRUE(result.certificate.lacks_hessian);
    const DeformResult expected = exact.solve(std::array{motion});
    EXPECT_FALSE(expected.certificate.lacks_hessian);
    EXPECT_LT(largest_distance(result.positions, expected.positions), 1e-6);
  }
}

TEST_F(DeformSolverTest, WithoutMemoryAndSettlingItSaysHowMuchItNeeds) {
  DeformOptions options = test::linear_options();
  options.memory_limit_bytes = 1000;
  EXPECT_THAT(error_message<SolverError>([&] { solver(options); }),
              ::testing::HasSubstr("limit of 1 MB; choose a smaller region"));
}

TEST_F(DeformSolverTest, ProgressCanCancelAtEveryStage) {
  std::vector<std::string> stages;
  const auto record = [&](std::string_view stage, double) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    return true;
  };
  const auto cancelled_at = [&](const auto& work) {
    for (const std::string& stop : std::exchange(stages, {})) {
      EXPECT_THROW(work([&](std::string_view stage, double) { return stage != stop; }), Cancelled)
          << stop;
    }
  };
  solver(test::linear_options(), record);
  EXPECT_THAT(stages, ::testing::ElementsAre("pattern", "order", "laplacian", "assemble", "analyze",
                                             "normal_matrix", "factor", "shares"));
  cancelled_at([&](const Progress& stop) { solver(test::linear_options(), stop); });
  solver({}, record);
  EXPECT_THAT(stages, ::testing::ElementsAre("pattern", "order", "laplacian", "shares"));
  cancelled_at([&](const Progress& stop) { solver({}, stop); });
  solver().response(record);
  EXPECT_THAT(stages,
              ::testing::ElementsAre("assemble", "analyze", "normal_matrix", "factor", "response"));
  cancelled_at([&](const Progress& stop) { solver().response(stop); });
}

TEST_F(DeformSolverTest, ALinearOneHasTheRestStretchOfOneThatSettles) {
  const DeformSolver settles = solver();
  const DeformSolver linear = solver(test::linear_options());
  const Affine3d moved(Eigen::Translation3d(0.5, 0.2, -0.3));
  const std::array scaled{Affine3d(moved * Eigen::Scaling(1.25))};
  EXPECT_THAT(linear.rest_stretch(std::array{moved}), ::testing::IsEmpty());
  EXPECT_THAT(linear.solve(std::array{moved}).rest_stretch, ::testing::IsEmpty());
  EXPECT_EQ(linear.rest_stretch(scaled), settles.rest_stretch(scaled));
  EXPECT_EQ(linear.solve(scaled).rest_stretch, settles.rest_stretch(scaled));
}

TEST_F(DeformSolverTest, WrongNumberOfMotionsAndWeightsAreRefused) {
  EXPECT_THROW(solver().solve(HandleMotions()), InputError);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    DeformOptions options;
    options.constraint_weight = bad;
    EXPECT_THROW(solver(options), InputError);
    options = {};
    options.detail_length = bad;
    EXPECT_THROW(solver(options), InputError);
  }
}

}  // namespace
}  // namespace lapwing
