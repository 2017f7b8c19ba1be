#include "lapwing/doctor/self_intersections.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/mesh/shapes.h"
#include "support/environment.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Pair = std::array<Index, 2>;

std::vector<Pair> pairs_of(const Mesh& mesh) {
  return self_intersections(mesh.topology().triangles, mesh.positions);
}

// Tests triangle 0 1 2 and the triangle `second`, which may share corners with it.
std::vector<Pair> pairs_of(const std::vector<Vector3d>& points, const Triangle& second) {
  const std::vector<Triangle> triangles{{0, 1, 2}, second};
  return self_intersections(triangles, points);
}

TEST(SelfIntersections, GeneratedShapesHaveNone) {
  EXPECT_THAT(pairs_of(grid(20, 20)), IsEmpty());
  EXPECT_THAT(pairs_of(icosphere(4)), IsEmpty());
  EXPECT_THAT(pairs_of(torus(40, 20, 1.0, 0.3)), IsEmpty());
  EXPECT_THAT(pairs_of(bar(4, 10, 1.0, 5.0)), IsEmpty());
}

TEST(SelfIntersections, TrianglesThatCutThroughEachOtherArePaired) {
  const std::vector<Vector3d> points{{0, 0, 0},      {2, 0, 0},     {0, 2, 0},
                                     {0.5, 0.5, -1}, {0.5, 0.5, 1}, {3, 3, 0}};
  EXPECT_THAT(pairs_of(points, {3, 4, 5}), ElementsAre(Pair{0, 1}));
}

TEST(SelfIntersections, TrianglesThatTouchArePaired) {
  const std::vector<Vector3d> corner{{0, 0, 0},     {2, 0, 0},     {0, 2, 0},
                                     {0.5, 0.5, 0}, {0.5, 0.5, 1}, {1, 1, 1}};
  EXPECT_THAT(pairs_of(corner, {3, 4, 5}), SizeIs(1));
  const std::vector<Vector3d> in_plane{{0, 0, 0},     {3, 0, 0},   {0, 3, 0},
                                       {0.5, 0.5, 0}, {1, 0.5, 0}, {0.5, 1, 0}};
  EXPECT_THAT(pairs_of(in_plane, {3, 4, 5}), SizeIs(1));
}

TEST(SelfIntersections, TrianglesApartAreNotPaired) {
  const std::vector<Vector3d> above{{0, 0, 0},         {2, 0, 0},     {0, 2, 0},
                                    {0.5, 0.5, 1e-12}, {0.5, 0.5, 1}, {1, 1, 1}};
  EXPECT_THAT(pairs_of(above, {3, 4, 5}), IsEmpty());
  const std::vector<Vector3d> in_plane{{0, 0, 0},     {2, 0, 0}, {0, 2, 0},
                                       {1.1, 1.1, 0}, {2, 1, 0}, {2, 2, 0}};
  EXPECT_THAT(pairs_of(in_plane, {3, 4, 5}), IsEmpty());
}

TEST(SelfIntersections, TrianglesOnOneEdgeArePairedOnlyWhereTheyLieOnEachOther) {
  const auto folded = [](const Vector3d& apex) {
    return pairs_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, apex}, {1, 0, 3});
  };
  EXPECT_THAT(folded({0.5, -1, 0}), IsEmpty());
  EXPECT_THAT(folded({0.5, 1, 1e-9}), IsEmpty());
  EXPECT_THAT(folded({0.5, 1, 0}), SizeIs(1));
}

TEST(SelfIntersections, TrianglesAtOneCornerArePairedWhereTheyCutThroughEachOther) {
  const auto at_corner = [](const Vector3d& a, const Vector3d& b) {
    return pairs_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a, b}, {0, 3, 4});
  };
  EXPECT_THAT(at_corner({-1, 0, 0}, {0, -1, 0}), IsEmpty());
  EXPECT_THAT(at_corner({1, 1, 1}, {1, 1, -1}), SizeIs(1));
  EXPECT_THAT(at_corner({0.2, 0.3, 0}, {0.3, 0.2, 0}), SizeIs(1));
}

TEST(SelfIntersections, ASpherePushedThroughItselfIsFoundAnywhere) {
  Mesh mesh = icosphere(3);
  mesh.positions[7] *= -1.5;
  const auto pairs = pairs_of(mesh);
  EXPECT_FALSE(pairs.empty());
  for (const double scale : {1e-9, 1.0, 1e9}) {
    Mesh moved = mesh;
    const Eigen::AngleAxisd turn(1.1, Vector3d(1, 2, -1).normalized());
    for (Vector3d& p : moved.positions) p = scale * (turn * p + Vector3d(3, -2, 5));
    EXPECT_EQ(pairs_of(moved), pairs) << scale;
  }
}

TEST(SelfIntersections, MatchComparingEveryPair) {
  std::srand(1);
  std::vector<Vector3d> points;
  std::vector<Triangle> triangles;
  for (Index t = 0; t < 200; ++t) {
    const Vector3d center = 3.0 * Vector3d::Random();
    for (int k = 0; k < 3; ++k) points.push_back(center + Vector3d::Random());
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  std::vector<Pair> expected;
  for (Index a = 0; a < 200; ++a) {
    for (Index b = a + 1; b < 200; ++b) {
      const std::vector<Triangle> two{triangles[a], triangles[b]};
      if (!self_intersections(two, points).empty()) expected.push_back({a, b});
    }
  }
  EXPECT_GT(expected.size(), 50U);
  EXPECT_EQ(self_intersections(triangles, points), expected);
}

TEST(SelfIntersections, TrianglesWithoutAreaAreLeftOut) {
  const std::vector<Vector3d> points{{0, 0, 0},      {2, 0, 0},     {0, 2, 0},
                                     {0.5, 0.5, -1}, {0.5, 0.5, 1}, {0.5, 0.5, 3}};
  EXPECT_THAT(pairs_of(points, {3, 4, 5}), IsEmpty());
}

// Returns a fan of triangles that share an apex. The bounding box of each triangle overlaps the
// boxes of a quarter of the fan.
Mesh fan(Index count) {
  Mesh mesh;
  mesh.positions.emplace_back(0, 0, 0);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  for (Index k = 0; k < count; ++k) {
    const std::array<Index, 3> triangle{0, 1 + k, 1 + (k + 1) % count};
    mesh.add_face(triangle);
  }
  return mesh;
}

TEST(SelfIntersections, OfFansOfVeryManyTrianglesAreRefused) {
  EXPECT_THAT(pairs_of(fan(100)), IsEmpty());
  const test::Environment lower(kMostPairs.variable, "1000");
  EXPECT_THAT(pairs_of(fan(100)), IsEmpty()) << "a hundred for each triangle are always allowed";
  EXPECT_THAT(error_message<InputError>([] { pairs_of(fan(2000)); }),
              AllOf(HasSubstr("2000 triangles overlap in more than 200000 pairs"),
                    HasSubstr("set LAPWING_MOST_PAIRS to a larger number")));
  const test::Environment higher(kMostPairs.variable, "1e9");
  EXPECT_THAT(pairs_of(fan(2000)), IsEmpty());
}

TEST(SelfIntersections, OfVeryManyCopiesOfOneTriangleAreRefused) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::array<Index, 3> triangle{0, 1, 2};
  for (int k = 0; k < 20'000; ++k) mesh.add_face(triangle);
  EXPECT_THAT(error_message<InputError>([&] { pairs_of(mesh); }),
              HasSubstr("Remove repeated faces with `lapwing check MESH --fix OUT`"));
}

}  // namespace
}  // namespace lapwing
