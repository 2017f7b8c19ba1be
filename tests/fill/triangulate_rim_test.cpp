#include "lapwing/fill/triangulate_rim.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lapwing {
namespace {

const auto kNoEdge = [](Index, Index) { return false; };

Eigen::Vector3d area_vector(std::span<const Triangle> triangles, const Positions& rim) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : triangles) sum += (rim[b] - rim[a]).cross(rim[c] - rim[a]) / 2.0;
  return sum;
}

double area(std::span<const Triangle> triangles, const Positions& rim) {
  double sum = 0.0;
  for (const Triangle& t : triangles) sum += area_vector(std::span(&t, 1), rim).norm();
  return sum;
}

TEST(TriangulateRim, APlanePolygonIsCoveredOnce) {
  // An L of area 3.
  const Positions rim{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  const auto triangles = triangulate_rim(rim, kNoEdge);
  EXPECT_EQ(triangles.size(), 4U);
  EXPECT_NEAR(area(triangles, rim), 3.0, 1e-12);
  EXPECT_NEAR(area_vector(triangles, rim).z(), 3.0, 1e-12);
}

TEST(TriangulateRim, AQuadIsCutAlongTheDiagonalOfSmallerArea) {
  // Two equilateral triangles on the short diagonal 1-3 are smaller than two on the long one.
  const Positions rim{{1, 0, 1}, {0, -0.2, 0}, {-1, 0, 1}, {0, 0.2, 0}};
  for (const Triangle& t : triangulate_rim(rim, kNoEdge)) {
    EXPECT_NE(std::ranges::find(t, 1U), t.end());
    EXPECT_NE(std::ranges::find(t, 3U), t.end());
  }
}

TEST(TriangulateRim, AvoidsDiagonalsThatAreEdgesOfTheMesh) {
  const Positions rim{{1, 0, 1}, {0, -0.2, 0}, {-1, 0, 1}, {0, 0.2, 0}};
  const auto is_edge = [](Index a, Index b) { return a == 1 && b == 3; };
  for (const Triangle& t : triangulate_rim(rim, is_edge)) {
    EXPECT_NE(std::ranges::find(t, 0U), t.end());
    EXPECT_NE(std::ranges::find(t, 2U), t.end());
  }
}

TEST(TriangulateRim, LongRimsAreCutToo) {
  Positions rim;
  const std::size_t n = kMostAreaVertices + 100;
  for (std::size_t k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n);
    rim.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const auto triangles = triangulate_rim(rim, kNoEdge);
  EXPECT_EQ(triangles.size(), n - 2);
  EXPECT_NEAR(area_vector(triangles, rim).z(), std::numbers::pi, 1e-3);
}

}  // namespace
}  // namespace lapwing
