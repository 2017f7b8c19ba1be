#include <gtest/gtest.h>

#include "coating/coating_scenes.h"
#include "lapwing/base/errors.h"
#include "lapwing/coating/fairing.h"
#include "lapwing/coating/mix_weight.h"
#include "support/bent_tube.h"
#include "support/error_message.h"

namespace lapwing::test {
namespace {

using Eigen::Vector3d;

constexpr Index kCells = 60;
constexpr double kFrameSize = 0.5;

Mesh dune() {
  Mesh mesh = grid(kCells, kCells);
  for (Vector3d& p : mesh.positions) {
    p.z() = 0.1 * std::sin(3.0 * p.x() + 0.5) * std::cos(2.0 * p.y());
  }
  return mesh;
}

Coating whole(const PatchedMesh& source) {
  CpuKernels kernels;
  return whole_shape(source.patch, source.mesh.positions, source.topology, kFrameSize,
                     LaplacianWeights::cotangent, kernels);
}

Positions smooth_of(const PatchedMesh& target) {
  return smooth_around(target.patch.vertices, kFrameSize, target.mesh.positions, target.topology,
                       LaplacianWeights::cotangent, "frame_size");
}

std::vector<double> complement(std::vector<double> weights) {
  for (double& w : weights) w = 1.0 - w;
  return weights;
}

std::vector<double> weights_of(const MixWeight& weight, const PatchedMesh& target,
                               Domain domain = Domain::square) {
  const auto pins = default_pins(target.patch, target.own, domain);
  const auto map = mean_value_map(target.patch, target.own, domain, pins);
  const auto field = weight_field(weight, target.mesh, "weight");
  return mix_weights(weight, field, target.patch, map, "weight");
}

TEST(Mix, OfASurfaceWithItselfIsThatSurface) {
  const PatchedMesh target(dune());
  const Coating shape = whole(target);
  const auto points = each_to_itself(target.patch);
  const auto w = weights_of({DomainRamp{0.3, 0.7}}, target);
  const Positions smooth = smooth_of(target);
  CpuKernels kernels;
  Coater coater({.rest = target.mesh.positions, .smooth = smooth, .whole = true}, target.topology,
                target.patch, {}, kernels);
  const auto not_w = complement(w);
  const std::vector<CoatLayer> layers{{shape, points, {}, not_w}, {shape, points, {}, w}};
  coater.take(layers);
  EXPECT_LT(largest_distance(coater.coat(1.0), target.mesh.positions), 1e-9);
}

TEST(Mix, HasTheFirstSourceOnOneSideAndTheSecondOnTheOther) {
  const PatchedMesh target(dune());
  const PatchedMesh fine(relief(kCells, 6.0, 0.01));
  const PatchedMesh coarse(relief(kCells, 3.0, 0.02));
  const Coating a = peel_cotangent(fine, 0.6);
  const Coating b = peel_cotangent(coarse, 1.0);
  const auto points = each_to_itself(target.patch);
  // By y, which is v here but for the dune's shape.
  PaintedWeight painted;
  for (const Vector3d& p : target.mesh.positions) {
    painted.field.push_back(fade({0.2}, p.y() - 0.4));
  }
  const auto w = weights_of({painted}, target);
  CpuKernels kernels;
  CoaterOptions options;
  options.hold_length = 0.6;
  const auto coated = [&](const std::vector<CoatLayer>& layers) {
    Coater coater({target.mesh.positions}, target.topology, target.patch, options, kernels);
    coater.take(layers);
    return coater.coat(1.0);
  };
  const CoatOptions same_size{MappedSampling::one_ring, 1.0};
  const auto not_w = complement(w);
  const Positions mixed = coated({{a, points, same_size, not_w}, {b, points, same_size, w}});
  const Positions only_a = coated({{a, points, same_size}});
  const Positions only_b = coated({{b, points, same_size}});
  double largest = 0.0;
  for (std::size_t v = 0; v < mixed.size(); ++v) {
    const double y = grid(kCells, kCells).positions[v].y();
    if (y < 0.3) largest = std::max(largest, (mixed[v] - only_a[v]).norm());
    if (y > 0.7) largest = std::max(largest, (mixed[v] - only_b[v]).norm());
  }
  EXPECT_LT(largest, 0.1 * largest_distance(only_a, only_b));
}

TEST(Mix, HoldsAnchorsAndMovesHandles) {
  const PatchedMesh target(dune());
  const Coating shape = whole(target);
  const auto points = each_to_itself(target.patch);
  const Positions smooth = smooth_of(target);
  const Index middle = (kCells / 2) * (kCells + 1) + kCells / 2;
  const std::vector<HeldVertex> held{{middle, Vector3d(0, 0, 0.1)}};
  CpuKernels kernels;
  Coater coater({.rest = target.mesh.positions, .smooth = smooth, .whole = true, .held = held},
                target.topology, target.patch, {}, kernels);
  coater.take(shape, points, {});
  const Positions moved = coater.coat(1.0);
  EXPECT_GT(moved[middle].z() - target.mesh.positions[middle].z(), 0.09);
  // Around it the surface follows.
  EXPECT_GT(moved[middle + 3].z() - target.mesh.positions[middle + 3].z(), 0.05);
}

TEST(Mix, NamesAHandleOffThePatch) {
  const PatchedMesh target(dune(), within(dune(), Vector3d(0.5, 0.5, 0.0), 0.3));
  const std::vector<HeldVertex> held{{0, Vector3d::UnitZ()}};
  CpuKernels kernels;
  EXPECT_THAT(error_message<InputError>([&] {
                Coater({.rest = target.mesh.positions, .held = held}, target.topology, target.patch,
                       {}, kernels);
              }),
              testing::StartsWith("vertex 0 is held, but it is outside the target patch"));
}

TEST(MixWeight, GoesFromNoneToAllAlongTheDomainsV) {
  const PatchedMesh target(grid(20, 20));
  const auto w = weights_of({DomainRamp{0.25, 0.75}, Transition::Profile::linear}, target);
  const auto map = mean_value_map(target.patch, target.own, Domain::square,
                                  default_pins(target.patch, target.own, Domain::square));
  for (std::size_t own = 0; own < w.size(); ++own) {
    EXPECT_NEAR(w[own], std::clamp((map.points[own].y() - 0.25) / 0.5, 0.0, 1.0), 1e-12);
  }
}

TEST(MixWeight, FallsWithTheDistanceToARegion) {
  const PatchedMesh target(grid(20, 20));
  const RegionSpec middle{ListedVertices{{220}}};
  const auto w =
      weights_of({DistanceRamp{middle, 0.4}, Transition::Profile::linear}, target, Domain::disk);
  for (std::size_t own = 0; own < w.size(); ++own) {
    const double distance = (target.mesh.positions[own] - target.mesh.positions[220]).norm();
    EXPECT_NEAR(w[own], std::max(0.0, 1.0 - distance / 0.4), 0.02);
  }
  const auto sharp = weights_of({DistanceRamp{middle, 0.0}}, target, Domain::disk);
  EXPECT_EQ(std::count(sharp.begin(), sharp.end(), 1.0), 1);
}

TEST(MixWeight, NamesWhatDoesNotFit) {
  const PatchedMesh target(grid(6, 6));
  const auto message = [&](const MixWeight& weight, Domain domain) {
    return error_message<InputError>([&] { weights_of(weight, target, domain); });
  };
  EXPECT_THAT(message({DomainRamp{}}, Domain::disk),
              testing::StartsWith("weight/domain_v: only the square domain has a coordinate v"));
  EXPECT_THAT(message({DomainRamp{0.5, 0.5}}, Domain::square),
              testing::StartsWith("weight/domain_v: the ramp has no extent"));
  EXPECT_THAT(message({PaintedWeight{{0.0, 1.0}}}, Domain::disk),
              testing::StartsWith("weight/field: expected one number for each of the target's 49 "
                                  "vertices, got 2"));
  PaintedWeight outside{std::vector<double>(49, 0.5)};
  outside.field[7] = 2.0;
  EXPECT_THAT(message({outside}, Domain::disk),
              testing::StartsWith("weight/field/7: expected a number from 0 to 1, got 2"));
}

}  // namespace
}  // namespace lapwing::test
