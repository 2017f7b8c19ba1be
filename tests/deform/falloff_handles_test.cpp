// Tests handles whose weight decreases with the distance from the handle.
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Dense>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/constraints.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"
#include "support/error_message.h"
#include "support/largest_distance.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// A sheet of 40 x 40 squares, held at its rim, whose middle is lifted.
class AHandleWithFalloff : public ::testing::Test {
 protected:
  AHandleWithFalloff() {
    request_.roi = {AllVertices{}, "roi"};
    request_.belt = BoundaryAnchors{0.1, "belt"};
    request_.handles = {{kDisk, SimilarityMove{.translate = {0, 0, 0.15}}}};
  }
  Falloff& falloff() { return request_.handles[0].falloff; }
  Positions done() const { return deform(mesh_, request_).mesh.positions; }
  std::vector<double> field(const std::function<double(double)>& of_distance) const {
    std::vector<double> field;
    for (const Vector3d& p : mesh_.positions) {
      field.push_back(of_distance((p - Vector3d(0.5, 0.5, 0)).norm()));
    }
    return field;
  }
  // The largest angle between two triangles at the handle's rim, in degrees.
  double rim_angle(const Positions& positions) const {
    const Topology& topology = mesh_.topology();
    const auto normal = [&](Index t) {
      const auto& [a, b, c] = topology.triangles[t];
      return Vector3d(
          (positions[b] - positions[a]).cross(positions[c] - positions[a]).normalized());
    };
    double largest = 0.0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double distance = (mesh_.positions[v] - Vector3d(0.5, 0.5, 0)).norm();
      if (std::abs(distance - kRadius) > 0.015) continue;
      for (const Index s : topology.vertex_triangles[v]) {
        for (const Index t : topology.vertex_triangles[v]) {
          if (s == t || !share_an_edge(topology.triangles[s], topology.triangles[t])) continue;
          largest = std::max(largest, std::acos(std::min(1.0, normal(s).dot(normal(t)))));
        }
      }
    }
    return largest * 180.0 / std::numbers::pi;
  }
  static bool share_an_edge(const Triangle& a, const Triangle& b) {
    return std::count_if(a.begin(), a.end(),
                         [&](Index v) { return std::find(b.begin(), b.end(), v) != b.end(); }) == 2;
  }

  static constexpr Index kColumns = 41;
  static constexpr double kRadius = 0.1;
  const RegionSpec kDisk = {GeodesicDisk{Index{20 * kColumns + 20}, kRadius}, "handle"};
  Mesh mesh_ = grid(kColumns - 1, kColumns - 1);
  DeformRequest request_;
};

TEST_F(AHandleWithFalloff, OfWeightOneEverywhereIsAFirmOne) {
  const Positions firm = done();
  falloff() = {.field = field([](double) { return 1.0; })};
  EXPECT_EQ(done(), firm);
  falloff() = {.transition = Transition{1e-6}};
  EXPECT_EQ(done(), firm);
  falloff() = {.transition = Transition{0.0}};
  EXPECT_EQ(done(), firm);
  falloff() = {.weight = 3.0};
  EXPECT_NE(done(), firm);
}

TEST_F(AHandleWithFalloff, PaintedWithOnesIsTheRegionOfThose) {
  for (const bool hard : {false, true}) {
    request_.parameters.hard = hard;
    request_.handles[0] = {kDisk, request_.handles[0].move};
    const Positions of_region = done();
    const VertexSet chosen = resolve(kDisk, mesh_);
    request_.handles[0].region = {GeodesicDisk{Index{20 * kColumns + 20}, 0.3}, "handle"};
    falloff().field.assign(mesh_.vertex_count(), 0.0);
    for (const Index v : chosen) falloff().field[v] = 1.0;
    EXPECT_EQ(done(), of_region) << hard;
  }
}

// With a wider falloff, a larger area follows the handle, and the surface bends less at its rim.
TEST_F(AHandleWithFalloff, GoesOverIntoTheSurfaceTheMoreGentlyTheWiderItFalls) {
  const auto height_at = [&](const Positions& positions, double distance) {
    const auto column = static_cast<Index>(std::lround((0.5 + distance) * (kColumns - 1)));
    return positions[20 * kColumns + column].z();
  };
  for (const bool hard : {false, true}) {
    request_.parameters.hard = hard;
    falloff() = {};
    const Positions firm = done();
    double last_height = height_at(firm, 0.2);
    double last_angle = rim_angle(firm);
    for (const double width : {0.1, 0.15, 0.2, 0.25, 0.3}) {
      falloff().transition = Transition{width};
      const Positions positions = done();
      EXPECT_GT(height_at(positions, 0.2), last_height) << width;
      EXPECT_LT(rim_angle(positions), last_angle) << width;
      last_height = height_at(positions, 0.2);
      last_angle = rim_angle(positions);
    }
  }
}

TEST_F(AHandleWithFalloff, IsWhereItIsPutAndWhatFallsOffIsNoError) {
  request_.parameters.hard = true;
  falloff().transition = Transition{0.2};
  const Deformed deformed = deform(mesh_, request_);
  for (const Index v : deformed.region.handles[0]) {
    EXPECT_EQ(deformed.mesh.positions[v], mesh_.positions[v] + Vector3d(0, 0, 0.15));
  }
  EXPECT_EQ(deformed.certificate.handle_error, 0.0);
  EXPECT_TRUE(deformed.certificate.settled);
  EXPECT_THAT(deformed.warnings, IsEmpty());
  EXPECT_FALSE(deformed.region.graded.empty());
}

TEST_F(AHandleWithFalloff, HoldsTheMoreTheMoreItWeighs) {
  double last = 1.0;
  for (const double weight : {0.01, 0.1, 1.0, 10.0}) {
    falloff().weight = weight;
    const double error = deform(mesh_, request_).certificate.handle_error;
    EXPECT_LT(error, last) << weight;
    last = error;
  }
}

TEST_F(AHandleWithFalloff, MovesWithTheSpaceItIsIn) {
  falloff() = {2.0, Transition{0.2}};
  request_.handles[0].move = SimilarityMove{{0.05, 0.02, 0.15}, {{1, 0, 0}, 30.0}};
  // On a regular sheet, many paths have the same length, and rounding would select one of them.
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    const auto number = static_cast<double>(v);
    mesh_.positions[v] += 0.003 * Vector3d(std::sin(3.0 * number), std::cos(5.0 * number), 0.0);
  }
  const Positions here = done();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Vector3d(2, -1, 3).normalized()).toRotationMatrix();
  constexpr double kScale = 4.0;
  const auto map = [&](const Vector3d& p) {
    return Vector3d(kScale * turn * p + Vector3d(7, -2, 5));
  };
  Mesh there = mesh_;
  for (Vector3d& p : there.positions) p = map(p);
  DeformRequest request = request_;
  request.handles[0].region = {GeodesicDisk{Index{20 * kColumns + 20}, kScale * kRadius}};
  request.handles[0].move =
      SimilarityMove{kScale * turn * Vector3d(0.05, 0.02, 0.15), {turn * Vector3d(1, 0, 0), 30.0}};
  request.handles[0].falloff.transition->width *= kScale;
  const Deformed deformed = deform(there, request);
  Positions expected;
  for (const Vector3d& p : here) expected.push_back(map(p));
  EXPECT_LT(test::largest_distance(deformed.mesh.positions, expected), 1e-8 * kScale);
}

// The least squares of equation 5 with rows w_h w_v^2 (v'_v - u_v), dense. Where it is hard, belt
// and handle are given instead.
Positions dense_solution(const Mesh& mesh, const EditRegion& region, const Eigen::Affine3d& motion,
                         const DeformRequest& request) {
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::cotangent);
  CpuKernels kernels;
  const BlockRows M =
      assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, region.roi});
  const auto n = static_cast<Eigen::Index>(3 * mesh.vertex_count());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * M.size()), n);
  for (std::size_t r = 0; r < M.size(); ++r) {
    for (std::size_t k = M.starts[r]; k < M.starts[r + 1]; ++k) {
      rows.block<3, 3>(static_cast<Eigen::Index>(3 * r), 3 * Eigen::Index{M.columns[k]}) =
          Eigen::Map<const Eigen::Matrix3d>(&M.values[9 * k]);
    }
  }
  Eigen::MatrixXd A = rows.transpose() * rows;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  const auto moved = [&](Index v) {
    return Vector3d(motion * mesh.positions[v] - mesh.positions[v]);
  };
  const auto hold = [&](Index v, double weight, const Vector3d& u) {
    const Eigen::Index at = 3 * Eigen::Index{v};
    A.diagonal().segment<3>(at).array() += weight * weight;
    b.segment<3>(at) = weight * weight * u;
  };
  const auto give = [&](Index v, double weight, const Vector3d& u) {
    if (!request.parameters.hard) return hold(v, weight, u);
    const Eigen::Index at = 3 * Eigen::Index{v};
    A.middleRows<3>(at).setZero();
    A.block<3, 3>(at, at).setIdentity();
    b.segment<3>(at) = u;
  };
  const double weight = *request.parameters.constraint_weight;
  const double full = weight * *request.handles[0].falloff.weight;
  for (const FalloffVertex& g : region.graded)
    hold(g.vertex, full * g.weight * g.weight, moved(g.vertex));
  for (const Index v : region.belt) give(v, weight, Vector3d::Zero());
  for (const Index v : region.handles[0]) give(v, full, moved(v));
  const Eigen::PartialPivLU<Eigen::MatrixXd> factor(A);
  Eigen::VectorXd u = factor.solve(b);
  for (int k = 0; k < 3; ++k) u += factor.solve(b - A * u);
  Positions positions = mesh.positions;
  for (Index v = 0; v < mesh.vertex_count(); ++v) positions[v] += u.segment<3>(3 * Eigen::Index{v});
  return positions;
}

TEST_F(AHandleWithFalloff, SolvesTheLinearSystemAsADenseSolutionDoes) {
  const Mesh tube = test::bumpy_tube();
  const EditRegion ends = test::foot_and_head(tube);
  DeformRequest request;
  request.roi = {AllVertices{}, "roi"};
  request.belt = RegionSpec{ListedVertices{ends.belt}};
  const SimilarityMove move{
      {0.3, 0.1, 0.2}, {{1, 1, 0}, 20.0}, Vector3d::Ones(), Vector3d(0, 0, 3)};
  request.handles = {{{ListedVertices{ends.handles[0]}}, move, {0.7, Transition{0.8}}}};
  request.parameters.response = LinearResponse::rsi;
  request.parameters.constraint_weight = 1.5;
  request.parameters.settle.reset();
  for (const bool hard : {false, true}) {
    request.parameters.hard = hard;
    const Deformed deformed = deform(tube, request);
    EXPECT_THAT(deformed.region.graded, SizeIs(::testing::Gt(40U)));
    const Positions expected =
        dense_solution(tube, deformed.region, to_affine(move, {0, 0, 0}), request);
    EXPECT_LT(test::largest_distance(deformed.mesh.positions, expected), 1e-9) << hard;
  }
}

// Two edits of one region share all prepared data except the weights.
TEST_F(AHandleWithFalloff, IsTheSameAfterAnotherOnTheSameRegion) {
  CpuKernels kernels;
  DeformWorkspace workspace;
  deform(mesh_, request_, kernels, workspace);
  falloff() = {0.5, Transition{0.2}};
  EXPECT_EQ(deform(mesh_, request_, kernels, workspace).mesh.positions, done());
}

TEST_F(AHandleWithFalloff, LeavesNothingMovedOnAnError) {
  falloff().field = {1.0, 0.5};
  EXPECT_EQ(error_message<InputError>([&] { done(); }),
            "handle: expected a weight for each of the mesh's 1681 vertices, got 2");
}

}  // namespace
}  // namespace lapwing
