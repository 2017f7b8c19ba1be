#include "lapwing/parameterize/domain_locator.h"

#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "parameterize/test_patches.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using test::hills;
using test::placed;
using test::PlacedPatch;

// The triangle that holds `p` best, of all of them: largest least barycentric coordinate.
double best_fit(std::span<const Triangle> triangles, std::span<const Vector2d> points,
                const Vector2d& p) {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : triangles) {
    Eigen::Matrix2d edges;
    edges << points[b] - points[a], points[c] - points[a];
    const Vector2d weights = edges.inverse() * (p - points[a]);
    best = std::max(best, std::min({weights.x(), weights.y(), 1.0 - weights.sum()}));
  }
  return best;
}

double nearest_on_boundary(const std::vector<Index>& loop, std::span<const Vector2d> points,
                           const Vector2d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vector2d a = points[loop[k]];
    const Vector2d edge = points[loop[(k + 1) % loop.size()]] - a;
    const double share = std::clamp((p - a).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (a + share * edge - p).norm());
  }
  return nearest;
}

void expect_valid(const SurfacePoint& found) {
  for (const double w : found.weights) EXPECT_GE(w, 0.0);
  EXPECT_NEAR(found.weights[0] + found.weights[1] + found.weights[2], 1.0, 1e-15);
}

struct Located {
  PlacedPatch patch;
  std::vector<Vector2d> points;
  DomainLocator locator;

  explicit Located(const Mesh& mesh, Domain domain)
      : patch(placed(mesh)),
        points(patch.map(domain).points),
        locator(patch.patch.triangles, points) {}

  Vector2d place(const SurfacePoint& found) const {
    return found.of(std::span<const Vector2d>(points));
  }
};

TEST(DomainLocator, FindsInsideWhatASearchOfAllTrianglesFinds) {
  const Located sheet(hills(), Domain::disk);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  int inside = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector2d p(coordinate(random), coordinate(random));
    const SurfacePoint found = sheet.locator.locate(p);
    expect_valid(found);
    const double distance = (sheet.place(found) - p).norm();
    if (best_fit(sheet.patch.patch.triangles, sheet.points, p) >= 0.0) {
      ++inside;
      EXPECT_LT(distance, 1e-15);
    } else {
      EXPECT_NEAR(distance, nearest_on_boundary(sheet.patch.patch.loop, sheet.points, p), 1e-12);
    }
  }
  EXPECT_GT(inside, 800);
  EXPECT_LT(inside, 1800);
}

TEST(DomainLocator, VerticesAndEdgesAreFoundExactly) {
  for (const Domain domain : {Domain::disk, Domain::square}) {
    const Located sheet(hills(), domain);
    for (Index v = 0; v < sheet.points.size(); ++v) {
      const SurfacePoint found = sheet.locator.locate(sheet.points[v]);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(found.weights[k], found.corners[k] == v ? 1.0 : 0.0, 1e-14);
      }
    }
    for (const Triangle& t : sheet.patch.patch.triangles) {
      const Vector2d p = 0.3 * sheet.points[t[0]] + 0.7 * sheet.points[t[1]];
      const SurfacePoint found = sheet.locator.locate(p);
      expect_valid(found);
      EXPECT_LT((sheet.place(found) - p).norm(), 1e-15);
    }
  }
}

TEST(DomainLocator, ManyPointsAtOnceAreFoundAsOneByOne) {
  const Located sheet(hills(), Domain::square);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> coordinate(-0.1, 1.1);
  std::vector<Vector2d> points(3000);
  for (Vector2d& p : points) p = {coordinate(random), coordinate(random)};
  const std::vector<SurfacePoint> found = sheet.locator.locate(points);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const SurfacePoint one = sheet.locator.locate(points[k]);
    EXPECT_EQ(found[k].corners, one.corners);
    EXPECT_EQ(found[k].weights, one.weights);
  }
}

// A fan of needles from one corner of the square, and a dense bundle of needles across it.
TEST(DomainLocator, NeedlesAreFound) {
  std::vector<Vector2d> points{{0, 0}};
  std::vector<Triangle> triangles;
  constexpr Index kNeedles = 400;
  for (Index k = 0; k <= kNeedles; ++k) {
    const double s = static_cast<double>(k) / kNeedles;
    points.emplace_back(1.0, s * s * s);
  }
  for (Index k = 0; k < kNeedles; ++k) triangles.push_back({0, 1 + k, 2 + k});
  const DomainLocator locator(triangles, points);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 3000; ++k) {
    const double x = share(random);
    const Vector2d p(x, x * std::pow(share(random), 4.0));
    const SurfacePoint found = locator.locate(p);
    expect_valid(found);
    EXPECT_LT((found.of(std::span<const Vector2d>(points)) - p).norm(), 1e-14);
  }
}

TEST(DomainLocator, TrianglesWithoutAreaDoNotDisturb) {
  const std::vector<Vector2d> points{{0, 0}, {1, 0}, {0, 1}, {0.5, 0.5}, {1, 1}, {0.5, 0.5}};
  const std::vector<Triangle> triangles{{0, 1, 3}, {0, 3, 2}, {3, 5, 3},
                                        {1, 5, 3}, {1, 4, 3}, {3, 4, 2}};
  const DomainLocator locator(triangles, points);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 500; ++k) {
    const Vector2d p(share(random), share(random));
    const SurfacePoint found = locator.locate(p);
    expect_valid(found);
    EXPECT_LT((found.of(std::span<const Vector2d>(points)) - p).norm(), 1e-15);
  }
}

TEST(DomainLocator, SingleTriangleAndNothing) {
  const std::vector<Vector2d> points{{0, 0}, {1, 0}, {0, 1}};
  const std::vector<Triangle> one{{0, 1, 2}};
  const SurfacePoint found = DomainLocator(one, points).locate(Vector2d(2, -5));
  EXPECT_EQ(found.of(std::span<const Vector2d>(points)), Vector2d(1, 0));
  EXPECT_TRUE(DomainLocator({}, {}).locate(Vector2d(0, 0)).is_nowhere());
  EXPECT_TRUE(DomainLocator(one, points).locate(Vector2d(0, std::nan(""))).is_nowhere());
}

}  // namespace
}  // namespace lapwing
