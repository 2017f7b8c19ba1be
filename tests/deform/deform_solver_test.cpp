#include "lapwing/deform/deform_solver.h"

#include <algorithm>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/drag_preview.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/dragged.h"
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

Positions deformed(const Mesh& mesh, const Affine3d& motion,
                   const DeformOptions& options = test::linear_options()) {
  CpuKernels kernels;
  const Topology& topology = mesh.topology();
  const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), options, kernels);
  return deformer.solve(std::array{motion}).positions;
}

class DeformerOptions : public ::testing::TestWithParam<DeformOptions> {};

TEST_P(DeformerOptions, StillHandleGivesTheInputBackBitForBit) {
  Mesh mesh = bumpy_tube();
  mesh.positions[5].x() = -0.0;
  const Positions result = deformed(mesh, Affine3d::Identity(), GetParam());
  EXPECT_EQ(std::memcmp(result.data(), mesh.positions.data(), sizeof(Vector3d) * result.size()), 0);
}

TEST_P(DeformerOptions, TranslatingHandleAndBeltTogetherTranslatesTheRegion) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  EditRegion region = foot_and_head(mesh);
  region.handles.push_back(std::move(region.belt));
  region.belt.clear();
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, region, GetParam(), kernels);
  const Affine3d shift(Eigen::Translation3d(1, -2, 3));
  const auto result = deformer.solve(std::array{shift, shift});
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    EXPECT_LT((result.positions[i] - shift * mesh.positions[i]).norm(), 1e-9);
  }
  EXPECT_LT(result.certificate.handle_error, 1e-9);
  EXPECT_NEAR(result.certificate.smallest_scale, 1.0, 1e-9);
}

TEST_P(DeformerOptions, ResultDoesNotDependOnPlaceUnitOrOrientation) {
  const Mesh mesh = bumpy_tube();
  const double diagonal = bounds_of(mesh.positions).diagonal();
  const Positions expected = deformed(mesh, bend(), GetParam());
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const double offset : {0.0, 1e4}) {
      const Affine3d frame = Eigen::Translation3d(scale * Vector3d(offset, -offset, offset)) *
                             Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized()) *
                             Eigen::Scaling(scale);
      Mesh moved = mesh;
      for (Vector3d& p : moved.positions) p = frame * p;
      Positions result = deformed(moved, frame * bend() * frame.inverse(), GetParam());
      for (Vector3d& p : result) p = frame.inverse() * p;
      EXPECT_LT(largest_distance(result, expected), 1e-6 * diagonal)
          << "scale " << scale << ", offset " << offset;
    }
  }
}

TEST_P(DeformerOptions, DragFollowsTheSolution) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), GetParam(), kernels);
  const std::array motions{bend()};
  EXPECT_LT(
      largest_distance(dragged(deformer.response(), motions), deformer.solve(motions).positions),
      1e-9);
}

TEST_P(DeformerOptions, SolvesTheNormalEquations) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), GetParam(), kernels);
  const auto result = deformer.solve(std::array{bend()});
  EXPECT_LT(result.certificate.relative_residual, 1e-9);
  EXPECT_TRUE(result.certificate.all_finite);
  if (GetParam().hard) {
    EXPECT_LT(result.certificate.handle_error, 1e-14);
  } else {
    EXPECT_GT(result.certificate.handle_error, 0.0);
  }
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
                      with(LaplacianWeights::uniform, true, LinearResponse::tangent)),
    [](const auto& test) {
      const DeformOptions& o = test.param;
      return std::string(o.response == LinearResponse::rsi ? "Rsi" : "Tangent") +
             std::string(o.weights == LaplacianWeights::uniform ? "Uniform" : "Cotangent") +
             (o.hard ? "Hard" : "Soft");
    });

TEST(DeformSolver, SettlingKeepsDetailThroughALargeTurn) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  const std::array turn{Affine3d(Eigen::AngleAxisd(2.0, Vector3d::UnitZ()))};
  CpuKernels kernels;
  const auto certificate_of = [&](const DeformOptions& options) {
    const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), options, kernels);
    return deformer.solve(turn).certificate;
  };
  const Certificate linear = certificate_of(test::linear_options());
  const DeformOptions options;
  const Certificate settled = certificate_of(options);
  EXPECT_LT(2.0 * settled.detail_error, linear.detail_error);
  EXPECT_LT(settled.edge_stretch, linear.edge_stretch);
  EXPECT_TRUE(settled.settled);
  EXPECT_GT(settled.settle_iterations, 1);
  EXPECT_LE(settled.settle_last_step, options.settle->tolerance);
  EXPECT_EQ(linear.settle_iterations, 0);
}

TEST(DeformSolver, SettlingThatRunsOutOfIterationsSaysSo) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  DeformOptions options;
  options.settle.emplace().max_iterations = 2;
  const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), options, kernels);
  const Certificate certificate = deformer.solve(std::array{bend()}).certificate;
  EXPECT_FALSE(certificate.settled);
  EXPECT_EQ(certificate.settle_iterations, 2);
  EXPECT_GT(certificate.settle_last_step, options.settle->tolerance);
}

TEST(DeformSolver, StillHandleIsNotSettled) {
  const Mesh mesh = bumpy_tube();
  DeformOptions options;
  const Positions result = deformed(mesh, Affine3d::Identity(), options);
  EXPECT_EQ(std::memcmp(result.data(), mesh.positions.data(), sizeof(Vector3d) * result.size()), 0);
}

TEST(DeformSolver, VerticesOutsideTheRegionKeepTheirBits) {
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

TEST(DeformSolver, LooseVertexStaysUnlessAHandleTakesIt) {
  Mesh mesh = bumpy_tube();
  const auto loose = static_cast<Index>(mesh.vertex_count());
  EditRegion region = foot_and_head(mesh);
  mesh.positions.emplace_back(7, 7, 7);
  mesh.positions.emplace_back(8, 8, 8);
  region.roi.push_back(loose);
  region.roi.push_back(loose + 1);
  region.handles[0].push_back(loose + 1);
  CpuKernels kernels;
  const Topology& topology = mesh.topology();
  const Affine3d shift(Eigen::Translation3d(0, 0, 1));
  for (const bool hard : {false, true}) {
    const DeformSolver deformer(mesh.positions, topology, region,
                                with(LaplacianWeights::uniform, hard), kernels);
    const auto result = deformer.solve(std::array{shift});
    EXPECT_EQ(result.positions[loose], mesh.positions[loose]);
    EXPECT_LT((result.positions[loose + 1] - Vector3d(8, 8, 9)).norm(), 1e-12);
  }
}

TEST(DeformSolver, StrongerConstraintsHoldTheHandleBetter) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  double previous = std::numeric_limits<double>::infinity();
  for (const double weight : {0.3, 1.0, 10.0}) {
    DeformOptions options;
    options.constraint_weight = weight;
    const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), options, kernels);
    const double error = deformer.solve(std::array{bend()}).certificate.handle_error;
    EXPECT_LT(error, previous);
    previous = error;
  }
}

TEST(DeformSolver, WithoutMemoryForTheExactSystemItsDragsAreThePreviewsAndItSettlesAllTheSame) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  const EditRegion region = foot_and_head(mesh);
  CpuKernels kernels;
  DeformOptions options;
  options.settle.emplace().tolerance = 1e-8;
  options.settle->max_iterations = 1000;
  const DeformSolver exact(mesh.positions, topology, region, options, kernels);
  EXPECT_EQ(exact.response()->why_not_exact(), "");
  options.memory_limit_bytes = 1000;
  const DeformSolver deformer(mesh.positions, topology, region, options, kernels);
  EXPECT_THAT(deformer.response()->why_not_exact(),
              ::testing::AllOf(::testing::HasSubstr("240 vertices needs"),
                               ::testing::EndsWith("limit of 1 MB")));

  const std::array motions{bend()};
  const DragPreview preview(mesh.positions, topology, region, options);
  EXPECT_LT(
      largest_distance(dragged(deformer.response(), motions), dragged(preview.response(), motions)),
      1e-12);

  // Settling needs no 3n x 3n response.
  for (const Affine3d& motion : {bend(), Affine3d(Eigen::Translation3d(0.6, 0.0, 0.0))}) {
    const DeformResult result = deformer.solve(std::array{motion});
    EXPECT_TRUE(result.certificate.settled);
    EXPECT_TRUE(result.certificate.lacks_hessian);
    const DeformResult expected = exact.solve(std::array{motion});
    EXPECT_FALSE(expected.certificate.lacks_hessian);
    EXPECT_LT(largest_distance(result.positions, expected.positions), 1e-6);
  }
  const DeformResult still = deformer.solve(std::array{Affine3d::Identity()});
  EXPECT_EQ(still.positions, mesh.positions);
}

TEST(DeformSolver, WithoutMemoryAndSettlingItSaysWhatItNeeds) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  DeformOptions options = test::linear_options();
  options.memory_limit_bytes = 1000;
  try {
    const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), options, kernels);
    FAIL() << "took more than it may";
  } catch (const SolverError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("limit of 1 MB; choose a smaller region"));
  }
}

TEST(DeformSolver, ProgressCanCancelAtEveryStage) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
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
  const auto prepare = [&](const DeformOptions& options, const Progress& progress) {
    return DeformSolver(mesh.positions, topology, foot_and_head(mesh), options, kernels, progress);
  };
  prepare(test::linear_options(), record);
  EXPECT_THAT(stages, ::testing::ElementsAre("pattern", "order", "laplacian", "assemble", "analyze",
                                             "normal_matrix", "factor", "shares"));
  cancelled_at([&](const Progress& stop) { prepare(test::linear_options(), stop); });
  const DeformSolver deformer = prepare({}, record);
  EXPECT_THAT(stages, ::testing::ElementsAre("pattern", "order", "laplacian", "shares"));
  cancelled_at([&](const Progress& stop) { prepare({}, stop); });
  prepare({}, {}).response(record);
  EXPECT_THAT(stages,
              ::testing::ElementsAre("assemble", "analyze", "normal_matrix", "factor", "response"));
  cancelled_at([&](const Progress& stop) { prepare({}, {}).response(stop); });
}

TEST(DeformSolver, ALinearOneHasTheRestStretchOfOneThatSettles) {
  const Mesh mesh = bumpy_tube();
  CpuKernels kernels;
  const DeformSolver settles(mesh.positions, mesh.topology(), foot_and_head(mesh), {}, kernels);
  const DeformSolver linear(mesh.positions, mesh.topology(), foot_and_head(mesh),
                            test::linear_options(), kernels);
  const Eigen::Affine3d moved(Eigen::Translation3d(0.5, 0.2, -0.3));
  const std::array scaled{Eigen::Affine3d(moved * Eigen::Scaling(1.25))};
  EXPECT_THAT(linear.rest_stretch(std::array{moved}), ::testing::IsEmpty());
  EXPECT_THAT(linear.solve(std::array{moved}).rest_stretch, ::testing::IsEmpty());
  EXPECT_EQ(linear.rest_stretch(scaled), settles.rest_stretch(scaled));
  EXPECT_EQ(linear.solve(scaled).rest_stretch, settles.rest_stretch(scaled));
}

TEST(DeformSolver, RunsGiveTheSameBits) {
  const Mesh mesh = bumpy_tube();
  const Positions first = deformed(mesh, bend());
  const Positions second = deformed(mesh, bend());
  EXPECT_EQ(std::memcmp(first.data(), second.data(), sizeof(Vector3d) * first.size()), 0);
}

TEST(DeformSolver, WrongNumberOfMotionsAndWeightsAreRefused) {
  const Mesh mesh = bumpy_tube();
  const Topology& topology = mesh.topology();
  CpuKernels kernels;
  const DeformSolver deformer(mesh.positions, topology, foot_and_head(mesh), {}, kernels);
  EXPECT_THROW(deformer.solve(HandleMotions()), InputError);
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity()}) {
    DeformOptions options;
    options.constraint_weight = bad;
    EXPECT_THROW(DeformSolver(mesh.positions, topology, foot_and_head(mesh), options, kernels),
                 InputError);
    options = {};
    options.detail_length = bad;
    EXPECT_THROW(DeformSolver(mesh.positions, topology, foot_and_head(mesh), options, kernels),
                 InputError);
  }
}

}  // namespace
}  // namespace lapwing
