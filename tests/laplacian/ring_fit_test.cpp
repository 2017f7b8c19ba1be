#include "lapwing/laplacian/ring_fit.h"

#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// A vertex 0 with neighbours 1..count at random places.
struct Ring {
  Positions positions;
  std::vector<Index> neighbours;
};
Ring random_ring(Index count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Ring ring;
  for (Index k = 0; k <= count; ++k) {
    ring.positions.emplace_back(uniform(generator), uniform(generator), uniform(generator));
    if (k > 0) ring.neighbours.push_back(k);
  }
  return ring;
}

Positions mapped(const Positions& positions, const Eigen::Affine3d& map) {
  Positions out;
  for (const Vector3d& p : positions) out.push_back(map * p);
  return out;
}

// T_i = s I + [h]x for the motion of ring 0 from rest to current, by the formulas of RingFit.
struct LinearSimilarity {
  double s = 0.0;
  Vector3d h = Vector3d::Zero();
};
LinearSimilarity fit_linear_similarity(const Ring& ring, const Positions& current) {
  const RingFit fit = fit_ring(0, ring.neighbours, ring.positions);
  double dot = 0.0;
  Vector3d cross = Vector3d::Zero();
  for (const Index j : ring.neighbours) {
    const Vector3d x = ring.positions[j] - ring.positions[0] - fit.center;
    dot += x.dot(current[j] - current[0]);
    cross += x.cross(current[j] - current[0]);
  }
  return {dot * fit.inverse_S, fit.inverse_J * cross};
}

TEST(RingFit, RecoversAScaledInfinitesimalRotation) {
  const Ring ring = random_ring(6, 1);
  const double s = 1.7;
  const Vector3d h(0.3, -0.2, 0.9);
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
  map.linear() = s * Matrix3d::Identity() + cross_matrix(h);
  map.translation() = Vector3d(5, 6, 7);
  const LinearSimilarity fit = fit_linear_similarity(ring, mapped(ring.positions, map));
  EXPECT_NEAR(fit.s, s, 1e-13);
  EXPECT_LT((fit.h - h).norm(), 1e-13);
}

TEST(RingFit, RecoversEverySimilarity) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Ring ring = random_ring(3 + seed % 7, seed);
    const double scale = 0.1 + 0.2 * seed;
    const Eigen::Affine3d map =
        Eigen::Translation3d(1e3, -2e3, 5) *
        Eigen::AngleAxisd(0.07 * seed, Vector3d(1, 2.0 - seed, 3).normalized()) *
        Eigen::Scaling(scale);
    const RingSimilarity fit =
        fit_similarity(0, ring.neighbours, ring.positions, mapped(ring.positions, map));
    EXPECT_LT((scale * fit.R - map.linear()).norm(), 1e-10) << "seed " << seed;
    EXPECT_NEAR(fit.scale, scale, 1e-10) << "seed " << seed;
  }
}

TEST(RingFit, RotationOfAReflectedRingIsProper) {
  const Ring ring = random_ring(6, 4);
  Eigen::Affine3d mirror = Eigen::Affine3d::Identity();
  mirror.linear()(2, 2) = -1.0;
  const Matrix3d R =
      fit_rotation(0, ring.neighbours, ring.positions, mapped(ring.positions, mirror));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  EXPECT_LT((R * R.transpose() - Matrix3d::Identity()).norm(), 1e-12);
}

TEST(RingFit, CollinearRingTurnsWithItsLine) {
  Ring ring;
  ring.positions = {{0, 0, 0}, {1, 0, 0}, {-2, 0, 0}};
  ring.neighbours = {1, 2};
  const RingFit fit = fit_ring(0, ring.neighbours, ring.positions);
  EXPECT_TRUE(fit.inverse_J.allFinite());
  EXPECT_LT((fit.inverse_J * Vector3d::UnitX()).norm(), 1e-15);
  Positions turned;
  for (const Vector3d& p : ring.positions) turned.emplace_back(0, p.x(), 0);
  const Matrix3d R = fit_rotation(0, ring.neighbours, ring.positions, turned);
  EXPECT_LT((R * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
}

TEST(RingFit, RingAtOnePointHasNoFit) {
  const Positions same(4, Vector3d(1, 2, 3));
  const RingFit fit = fit_ring(0, std::vector<Index>{1, 2, 3}, same);
  EXPECT_EQ(fit.inverse_S, 0.0);
  EXPECT_TRUE(fit.inverse_J.isZero(0.0));
  EXPECT_TRUE(fit_rotation(0, std::vector<Index>{1, 2, 3}, same, same).isIdentity(0.0));
  EXPECT_EQ(fit_similarity(0, std::vector<Index>{1, 2, 3}, same, same).scale, 1.0);
}

}  // namespace
}  // namespace lapwing
