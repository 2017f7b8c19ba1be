// Stiffness factors of vertices.
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "deform/mirror_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/deform/coarse_proxy.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/shape_measures.h"
#include "lapwing/elastic/energy_minimizer.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "support/error_message.h"
#include "support/largest_distance.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;
using test::largest_distance;
using ::testing::HasSubstr;

const Affine3d kBend = test::turn_and_move(60, Vector3d::UnitX(), Vector3d(0, -1.5, -1));

// A rippled cylinder whose lower end is held and whose upper end moves.
class StiffCylinder : public ::testing::Test {
 protected:
  VertexSet between(double low, double high) const {
    VertexSet set;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      const double z = mesh_.positions[v].z();
      if (z > low && z < high) set.push_back(v);
    }
    return set;
  }
  EditRegion region_with(const VertexSet& part, double factor) const {
    EditRegion region = test::ends_of_cylinder(mesh_);
    for (const Index v : part) region.stiffness.push_back({v, factor});
    return region;
  }
  DeformResult bent(const EditRegion& region, const DeformOptions& options = {}) {
    return DeformSolver(mesh_.positions, mesh_.topology(), region, options, kernels_)
        .solve(std::array{kBend});
  }
  double mean_edge() const {
    double sum = 0.0;
    const std::vector<Triangle>& triangles = mesh_.topology().triangles;
    for (const Triangle& t : triangles)
      sum += (mesh_.positions[t[0]] - mesh_.positions[t[1]]).norm();
    return sum / static_cast<double>(triangles.size());
  }
  // The largest deviation of a part from its best rigid motion, in mean edge lengths.
  double deformation(const VertexSet& part, const Positions& positions) const {
    Eigen::Matrix3Xd from(3, part.size());
    Eigen::Matrix3Xd to(3, part.size());
    for (std::size_t k = 0; k < part.size(); ++k) {
      from.col(static_cast<Eigen::Index>(k)) = mesh_.positions[part[k]];
      to.col(static_cast<Eigen::Index>(k)) = positions[part[k]];
    }
    const Affine3d map(Eigen::umeyama(from, to, false));
    return (map * from - to).colwise().norm().maxCoeff() / mean_edge();
  }

  Mesh mesh_ = test::rippled_cylinder(20, 41);
  CpuKernels kernels_;
  DeformOptions exact_ = [] {
    DeformOptions options;
    options.settle = SettleOptions{.tolerance = 1e-8, .max_iterations = 2000};
    return options;
  }();
};

TEST_F(StiffCylinder, AConstantFactorKeepsTheMinimum) {
  const EditRegion region = test::ends_of_cylinder(mesh_);
  const Positions usual = bent(region, exact_).positions;
  for (const double factor : {0.01, 7.0}) {
    const Positions scaled = bent(region_with(region.roi, factor), exact_).positions;
    EXPECT_LT(largest_distance(usual, scaled), 1e-6 * mean_edge()) << factor;
  }
}

TEST_F(StiffCylinder, TheFactorOneGivesTheSameBits) {
  const EditRegion region = test::ends_of_cylinder(mesh_);
  EXPECT_EQ(bent(region).positions, bent(region_with(region.roi, 1.0)).positions);
  for (const auto& options : {DeformOptions(), test::linear_options()}) {
    EXPECT_EQ(bent(region, options).positions,
              bent(region_with(between(2, 4), 1.0), options).positions);
  }
}

TEST_F(StiffCylinder, TheGradientIsThatOfTheEnergy) {
  EditRegion region = region_with(between(1.5, 3.0), 30.0);
  for (const Index v : between(3.0, 4.0)) region.stiffness.push_back({v, 0.05});
  std::ranges::sort(region.stiffness, {}, &VertexStiffness::vertex);
  const Topology& topology = mesh_.topology();
  const Constraints constraints = constraints_of(region, topology, 1.0, false);
  const SystemPattern pattern(topology, region.roi, constraints.unknowns);
  StageTimings timings;
  const LaplacianSystem system(
      mesh_.positions, topology, region.roi, constraints, pattern,
      {LaplacianWeights::cotangent, kDefaultDetailLength, region.stiffness}, timings);
  EnergyMinimizer minimizer(kernels_, system, {});
  const std::vector<Vector3d> prescribed(mesh_.vertex_count(), Vector3d::Zero());
  std::vector<Vector3d> u(mesh_.vertex_count());
  for (Index v = 0; v < u.size(); ++v) u[v] = 0.1 * Vector3d(std::sin(v), std::cos(3.0 * v), 0.2);
  std::vector<Vector3d> gradient(u.size());
  minimizer.energy({prescribed}, u);
  minimizer.gradient(gradient);
  constexpr double kStep = 1e-5;
  for (Index v = 0; v < u.size(); v += 17) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<Vector3d> other = u;
      other[v][axis] += kStep;
      const double above = minimizer.energy({prescribed}, other);
      other[v][axis] -= 2.0 * kStep;
      const double below = minimizer.energy({prescribed}, other);
      const double slope = (above - below) / (2.0 * kStep);
      EXPECT_NEAR(slope, 2.0 * gradient[v][axis], 1e-5 * gradient[v].norm() + 1e-6) << v;
    }
  }
}

TEST_F(StiffCylinder, AStiffPartDeformsLessAndASoftPartMore) {
  const VertexSet part = between(2.0, 3.5);
  const auto stretch = [&](double factor) {
    const Positions positions = bent(region_with(part, factor)).positions;
    return edge_stretch(part, mesh_.topology(), mesh_.positions, positions);
  };
  EXPECT_LT(stretch(20.0), 0.5 * stretch(1.0));
  EXPECT_GT(stretch(0.1), 1.5 * stretch(1.0));
}

TEST_F(StiffCylinder, ARigidPartMovesAsOneBody) {
  const VertexSet low = between(1.0, 2.2);
  const VertexSet high = between(3.2, 4.5);
  const EditRegion region = region_with(unite(low, high), kRigidStiffness);
  const DeformResult result = bent(region);
  EXPECT_TRUE(result.certificate.settled);
  EXPECT_EQ(result.motions.maps.size(), 1U);
  EXPECT_LT(deformation(low, result.positions), 1e-3);
  EXPECT_LT(deformation(high, result.positions), 1e-3);
  EXPECT_GT(deformation(unite(low, high), result.positions), 1.0)
      << "each part moves as a separate body";
  EXPECT_GT(deformation(low, bent(test::ends_of_cylinder(mesh_)).positions), 0.1);
  // The details of the bodies are kept.
  const Topology& topology = mesh_.topology();
  const auto weights = laplacian_weights(topology, mesh_.positions, LaplacianWeights::cotangent);
  EXPECT_LT(detail_error(between(1.4, 1.8), topology, weights, mesh_.positions, result.positions),
            1e-3);
  // A weak constraint weight holds the handle softly, but not the bodies.
  DeformOptions soft;
  soft.constraint_weight = 1.0;
  EXPECT_LT(deformation(low, bent(region, soft).positions), 1e-3);
}

TEST_F(StiffCylinder, ARigidPartAroundAHandleOrTheBeltGoesWithIt) {
  EditRegion region = region_with(between(0.3, 1.5), kRigidStiffness);
  for (const Index v : between(4.5, 7.0)) region.stiffness.push_back({v, kRigidStiffness});
  std::ranges::sort(region.stiffness, {}, &VertexStiffness::vertex);
  const DeformResult result = bent(region);
  EXPECT_TRUE(result.certificate.settled);
  const double close = 0.02;
  for (const Index v : between(0.3, 1.5)) {
    EXPECT_LT((result.positions[v] - mesh_.positions[v]).norm(), close) << v;
  }
  for (const Index v : between(4.5, 7.0)) {
    EXPECT_LT((result.positions[v] - kBend * mesh_.positions[v]).norm(), close) << v;
  }
}

TEST_F(StiffCylinder, AFreeHandleStillTurnsBesideARigidPart) {
  const VertexSet part = between(2.0, 3.5);
  const auto turn = [&](double factor) {
    HandleMotions motions =
        handle_motions(std::array{Affine3d(Eigen::Translation3d(3.0, 0.0, -1.0))});
    motions.is_free = {1};
    const DeformSolver solver(mesh_.positions, mesh_.topology(), region_with(part, factor), {},
                              kernels_);
    const DeformResult result = solver.solve(motions);
    EXPECT_TRUE(result.certificate.settled);
    EXPECT_EQ(result.motions.is_free, motions.is_free);
    return shortest_turn(result.motions.maps[0]).angle();
  };
  const double stiff = turn(kStiffest);
  EXPECT_GT(stiff, 0.3);
  EXPECT_NEAR(turn(kRigidStiffness), stiff, 0.1 * stiff);
}

TEST_F(StiffCylinder, ALinearResponseKeepsAStiffPartStraight) {
  const VertexSet part = between(2.0, 3.5);
  const auto stretch = [&](double factor) {
    const DeformSolver solver(mesh_.positions, mesh_.topology(), region_with(part, factor),
                              test::linear_options(), kernels_);
    const Affine3d little = test::turn_and_move(0.1, Vector3d::UnitX(), Vector3d(0, 0.01, 0.01));
    return edge_stretch(part, mesh_.topology(), mesh_.positions,
                        solver.solve(std::array{little}).positions);
  };
  EXPECT_LT(stretch(kRigidStiffness), 0.01 * stretch(1.0));
}

TEST_F(StiffCylinder, TheCoarseProxyHasTheSameFactors) {
  mesh_ = test::rippled_cylinder();
  PreparedRegion prepared(mesh_.topology());
  const VertexSet part = between(2.0, 3.0);
  const EditSystem fine(prepared, mesh_.positions, region_with(part, 5.0), {}, {});
  const auto coarse = coarse_region(fine, 1000);
  ASSERT_NE(coarse, nullptr);
  const std::vector<VertexStiffness>& stiffness = coarse->edit->region.stiffness;
  ASSERT_FALSE(stiffness.empty());
  std::size_t kept = 0;
  for (const Index v : coarse->level->surface.kept) {
    kept += std::ranges::binary_search(part, v) ? 1U : 0U;
  }
  EXPECT_EQ(stiffness.size(), kept);
  for (const auto& [v, factor] : stiffness) {
    EXPECT_TRUE(std::ranges::binary_search(part, coarse->level->surface.kept[v]));
    EXPECT_EQ(factor, 5.0);
  }
}

TEST_F(StiffCylinder, ThePapersSystemHasNoStiffness) {
  const EditRegion region = region_with(between(2, 3), 2.0);
  EXPECT_THAT(error_message<InputError>([&] { bent(region, test::rsi_options()); }),
              HasSubstr("the paper's linear system does not support stiffness"));
}

TEST(Stiffness, TheLastPartThatContainsAVertexCounts) {
  const Mesh mesh = grid(2, 2);
  const std::vector<StiffnessSpec> specs{
      {{ListedVertices{{1, 2, 3}}}, 4.0},
      {{ListedVertices{{2}}}, 1.0},
      {{ListedVertices{{3, 4, 5}}}, 1.0, std::vector(9, kRigidStiffness)}};
  const std::vector<VertexStiffness> expected{{1, 4.0}, {3, kRigidStiffness}, {4, kRigidStiffness}};
  EXPECT_EQ(resolve_stiffness(specs, {1, 2, 3, 4}, mesh), expected);
}

TEST(Stiffness, AnInvalidFactorIsNamed) {
  const Mesh mesh = grid(2, 2);
  const auto message = [&](const StiffnessSpec& spec) {
    return error_message<InputError>([&] { resolve_stiffness(std::array{spec}, {0}, mesh); });
  };
  EXPECT_EQ(message({{AllVertices{}, "bone"}, 0.0}),
            "bone: the stiffness must be a factor from 0.01 to 100, or \"rigid\", not 0");
  EXPECT_THAT(message({{AllVertices{}, "bone"}, std::nan("")}), HasSubstr("not nan"));
  EXPECT_EQ(message({{AllVertices{}, "bone"}, 1.0, {1.0}}),
            "bone: expected a stiffness for each of the mesh's 9 vertices, got 1");
  std::vector<double> field(9, 1.0);
  field[4] = 101.0;
  EXPECT_EQ(message({{AllVertices{}, "bone"}, 1.0, field}),
            "bone: the stiffness of vertex 4 must be a factor from 0.01 to 100, or \"rigid\", not "
            "101");
}

TEST(Stiffness, IsMirroredWithTheEdit) {
  const Mesh mesh = grid(10, 10);
  DeformRequest request;
  request.roi.form = AllVertices{};
  const double middle = 0.5 * (mesh.positions.front().x() + mesh.positions.back().x());
  request.mirror = MirrorSpec{MirrorPlane{{middle, 0, 0}, Vector3d::UnitX()}};
  request.handles.push_back({{ListedVertices{{60}}}, SimilarityMove{}});
  std::vector<double> field(mesh.vertex_count(), 1.0);
  field[1] = 3.0;
  request.stiffness = {{{ListedVertices{{1, 12}}}, 1.0, field},
                       {{ListedVertices{{23}}}, kRigidStiffness}};
  const DeformRequest both = mirrored_request(request, mesh).request;
  const std::vector<Index> images = mirror_images(mesh, {{middle, 0, 0}, Vector3d::UnitX()}, "");
  EXPECT_EQ(resolve(both.stiffness[1].region, mesh), make_vertex_set({23, images[23]}));
  EXPECT_EQ(both.stiffness[0].field[images[1]], 3.0);
  EXPECT_EQ(both.stiffness[0].field[1], 3.0);
}

}  // namespace
}  // namespace lapwing
