#include "lapwing/mesh/closest_point.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

class ClosestPointOnTorus : public ::testing::Test {
 protected:
  ClosestPointOnTorus() {
    for (Index t = 0; t < topology.triangles.size(); ++t) (t % 3 == 0 ? left : right).push_back(t);
    Adjacency groups;
    for (const auto* group : {&left, &right}) {
      groups.values.insert(groups.values.end(), group->begin(), group->end());
      groups.starts.push_back(static_cast<Index>(groups.values.size()));
    }
    tree.emplace(topology.triangles, mesh.positions, groups);
  }

  std::array<Vector3d, 3> corners(Index t) const {
    const auto& [a, b, c] = topology.triangles[t];
    return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
  }

  Vector3d random_point() {
    std::uniform_real_distribution<double> coordinate(-1.6, 1.6);
    return {coordinate(random), coordinate(random), 0.4 * coordinate(random)};
  }

  Mesh mesh = torus(20, 11, 1.0, 0.4);
  Topology topology = mesh.topology();
  std::vector<Index> left, right;
  std::optional<ClosestPoint> tree;
  std::mt19937 random{7};
};

// The closest of many points of a triangle is no closer than the answer, and the answer is one.
TEST(ClosestWeights, NoPointOfTheTriangleIsCloser) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto point = [&] { return Vector3d(coordinate(random), coordinate(random), 0.3); };
  for (int i = 0; i < 200; ++i) {
    const std::array corners{point(), point(), point()};
    const Vector3d p = point() + Vector3d(0, 0, coordinate(random));
    const auto w = closest_weights(corners, p);
    EXPECT_NEAR(w[0] + w[1] + w[2], 1.0, 1e-12);
    EXPECT_GE(*std::min_element(w.begin(), w.end()), 0.0);
    const Vector3d found = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
    for (double a = 0.0; a <= 1.0; a += 0.05) {
      for (double b = 0.0; a + b <= 1.0; b += 0.05) {
        const Vector3d other = a * corners[0] + b * corners[1] + (1.0 - a - b) * corners[2];
        ASSERT_LE((found - p).norm(), (other - p).norm() + 1e-12);
      }
    }
  }
}

TEST(ClosestWeights, TrianglesWithoutAreaAreSegmentsOrPoints) {
  const Vector3d o(0, 0, 0), x(2, 0, 0), m(1, 0, 0), p(0.5, 1, 0);
  for (const std::array<Vector3d, 3>& corners : {std::array{o, x, x}, {x, o, m}, {m, x, o}}) {
    const auto w = closest_weights(corners, p);
    EXPECT_NEAR((w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2]).x(), 0.5, 1e-15);
  }
  const auto w = closest_weights({x, x, x}, p);
  EXPECT_EQ(w[0] + w[1] + w[2], 1.0);
}

TEST_F(ClosestPointOnTorus, TreeFindsWhatLookingAtEveryTriangleOfTheGroupFinds) {
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = random_point();
    for (Index g = 0; g < 2; ++g) {
      double best = std::numeric_limits<double>::infinity();
      for (const Index t : g == 0 ? left : right) {
        const auto c = corners(t);
        const auto w = closest_weights(c, p);
        best = std::min(best, (w[0] * c[0] + w[1] * c[1] + w[2] * c[2] - p).norm());
      }
      const TrianglePoint found = tree->find(g, p);
      ASSERT_NEAR((found.position - p).norm(), best, 1e-14);
      ASSERT_EQ(found.triangle % 3 == 0, g == 0);
      const TrianglePoint hinted = tree->find(g, p, Vector3d::Zero(), tree->find(g, -p).hint);
      ASSERT_EQ((hinted.position - p).norm(), (found.position - p).norm());
    }
  }
}

TEST_F(ClosestPointOnTorus, FindsEveryTriangleOfTheGroupWithinADistance) {
  for (int i = 0; i < 100; ++i) {
    const Vector3d p = random_point();
    const double distance = 0.02 * i;
    std::vector<Index> expected;
    for (const Index t : right) {
      const auto c = corners(t);
      const auto w = closest_weights(c, p);
      const Vector3d closest = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
      if ((closest - p).norm() <= distance) expected.push_back(t);
    }
    std::vector<Index> found;
    for (const TrianglePoint& place : tree->within(1, p, distance)) {
      found.push_back(place.triangle);
      ASSERT_LE((place.position - p).norm(), distance + 1e-14);
    }
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected);
  }
}

TEST_F(ClosestPointOnTorus, LeavesOutTrianglesThatLookTheOtherWay) {
  for (int i = 0; i < 100; ++i) {
    const Vector3d p = random_point();
    const Vector3d direction = random_point();
    double best = std::numeric_limits<double>::infinity();
    for (const Index t : right) {
      const auto c = corners(t);
      if ((c[1] - c[0]).cross(c[2] - c[0]).dot(direction) < 0.0) continue;
      const auto w = closest_weights(c, p);
      best = std::min(best, (w[0] * c[0] + w[1] * c[1] + w[2] * c[2] - p).norm());
    }
    ASSERT_NEAR((tree->find(1, p, direction).position - p).norm(), best, 1e-14);
  }
}

TEST_F(ClosestPointOnTorus, FindsOneAllTheSameWhereAllLookTheOtherWay) {
  const Index only = right.front();
  const auto c = corners(only);
  const ClosestPoint single(topology.triangles, mesh.positions, {{0, 1}, {only}});
  const Vector3d against = -(c[1] - c[0]).cross(c[2] - c[0]);
  EXPECT_EQ(single.find(0, c[0], against).triangle, only);
}

// Against every triangle, one after the other.
TEST_F(ClosestPointOnTorus, ARayLeavesTheSolidWhereATriangleThatLooksAlongItIsFirst) {
  for (int i = 0; i < 500; ++i) {
    const Vector3d from = random_point();
    const Vector3d along = random_point();
    double nearest = std::numeric_limits<double>::infinity();
    Index expected = kNoIndex;
    for (const Index t : right) {
      const auto [a, b, c] = corners(t);
      if ((b - a).cross(c - a).dot(along) <= 0.0) continue;
      Eigen::Matrix3d system;
      system << b - a, c - a, -along;
      const Vector3d at = system.inverse() * (from - a);
      if (at[0] < 0.0 || at[1] < 0.0 || at[0] + at[1] > 1.0 || at[2] <= 0.0) continue;
      if (at[2] < nearest) expected = t;
      nearest = std::min(nearest, at[2]);
    }
    const TrianglePoint found = tree->first_exit(1, from, along, from);
    ASSERT_EQ(found.triangle, expected) << "ray " << i;
    if (expected == kNoIndex) continue;
    EXPECT_LT((found.position - from - nearest * along).norm(), 1e-9);
  }
}

TEST_F(ClosestPointOnTorus, ARayFromAVertexPassesTheTrianglesAroundIt) {
  const Vector3d from = mesh.positions[0];
  for (const Vector3d& along : {Vector3d(1, 0, 0), Vector3d(-1, 0, 0), Vector3d(0, 0, 1)}) {
    const TrianglePoint found = tree->first_exit(1, from, along, from);
    if (found.triangle == kNoIndex) continue;
    for (const Vector3d& corner : corners(found.triangle)) EXPECT_NE(corner, from);
  }
}

}  // namespace
}  // namespace lapwing
