#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/mesh/topology.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;
using ::testing::SizeIs;

using Outline = std::vector<Vector2d>;

std::vector<Triangle> triangles_of(const Outline& outline) {
  std::vector<Index> polygon(outline.size());
  std::iota(polygon.begin(), polygon.end(), Index{0});
  std::vector<Eigen::Vector3d> positions;
  for (const Vector2d& p : outline) positions.emplace_back(p.x(), p.y(), 0.0);
  std::vector<Triangle> triangles;
  triangulate_polygon(polygon, positions, triangles);
  return triangles;
}

double orient(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Plain ear clipping, which tests every ear against all remaining corners.
std::vector<Triangle> clipped_one_by_one(const Outline& outline) {
  std::vector<Index> left(outline.size());
  std::iota(left.begin(), left.end(), Index{0});
  const auto corner = [&](std::size_t at) { return left[at % left.size()]; };
  const auto is_ear = [&](std::size_t at) {
    const Vector2d& a = outline[corner(at + left.size() - 1)];
    const Vector2d& b = outline[corner(at)];
    const Vector2d& c = outline[corner(at + 1)];
    return orient(a, b, c) > 0.0 && std::none_of(left.begin(), left.end(), [&](Index i) {
             const Vector2d& p = outline[i];
             return p != a && p != b && p != c && orient(a, b, p) >= 0.0 &&
                    orient(b, c, p) >= 0.0 && orient(c, a, p) >= 0.0;
           });
  };
  std::vector<Triangle> triangles;
  while (left.size() > 3) {
    std::size_t ear = 1;
    while (ear <= left.size() && !is_ear(ear)) ++ear;
    if (ear > left.size()) ear = 1;
    triangles.push_back({corner(ear + left.size() - 1), corner(ear), corner(ear + 1)});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear % left.size()));
  }
  triangles.push_back({left[0], left[1], left[2]});
  return triangles;
}

double area_of(const Outline& outline, const std::vector<Triangle>& triangles) {
  double area = 0.0;
  for (const auto& [a, b, c] : triangles) {
    area += 0.5 * std::abs(orient(outline[a], outline[b], outline[c]));
  }
  return area;
}

double area_of(const Outline& outline) {
  double doubled = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2d& next = outline[(i + 1) % outline.size()];
    doubled += outline[i].x() * next.y() - outline[i].y() * next.x();
  }
  return 0.5 * doubled;
}

class Outlines {
 public:
  // Returns a random outline, which intersects itself many times.
  Outline strewn(std::size_t corners) {
    Outline outline;
    for (std::size_t i = 0; i < corners; ++i)
      outline.push_back({number_(random_), number_(random_)});
    return outline;
  }
  // Returns an outline with coincident and collinear corners.
  Outline on_a_lattice(std::size_t corners) {
    Outline outline = strewn(corners);
    for (Vector2d& p : outline) p = (3.0 * p).array().round();
    return outline;
  }
  // Returns an outline that does not intersect itself.
  Outline star(std::size_t corners) {
    Outline outline;
    for (std::size_t i = 0; i < corners; ++i) {
      const double angle =
          2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
      const double radius = 0.6 + 0.4 * number_(random_);
      outline.push_back(radius * Vector2d(std::cos(angle), std::sin(angle)));
    }
    return outline;
  }

 private:
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

TEST(TriangulatePolygon, ClipsTheEarsThatLookingAtAllCornersFinds) {
  Outlines outlines;
  for (std::size_t corners = 4; corners < 90; corners += 1 + corners / 8) {
    for (int round = 0; round < 8; ++round) {
      for (const Outline& outline :
           {outlines.strewn(corners), outlines.on_a_lattice(corners), outlines.star(corners)}) {
        const Outline turned(outline.rbegin(), outline.rend());
        const Outline& left = area_of(outline) > 0.0 ? outline : turned;
        if (area_of(left) < 1e-9) continue;
        EXPECT_EQ(triangles_of(left), clipped_one_by_one(left)) << corners << ", " << round;
      }
    }
  }
}

TEST(TriangulatePolygon, CoversOneThatDoesNotCutThroughItself) {
  const Outline outline = Outlines().star(3000);
  const auto triangles = triangles_of(outline);
  EXPECT_THAT(triangles, SizeIs(outline.size() - 2));
  EXPECT_NEAR(area_of(outline, triangles), area_of(outline), 1e-12);
}

// Plain ear clipping would take hours on these outlines.
TEST(TriangulatePolygon, EndsSoonForVeryManyCornersHoweverTheyLie) {
  constexpr std::size_t kMany = 50'000;
  Outlines outlines;
  EXPECT_THAT(triangles_of(outlines.strewn(kMany)), SizeIs(kMany - 2));
  EXPECT_THAT(triangles_of(outlines.on_a_lattice(kMany)), SizeIs(kMany - 2));
  EXPECT_THAT(triangles_of(Outline(kMany, Vector2d(1.0, 2.0))), SizeIs(kMany - 2));
}

TEST(TriangulatePolygon, OfNumbersThatAreNoneEndsToo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = std::numeric_limits<double>::max();
  EXPECT_THAT(triangles_of({{0, 0}, {1, nan}, {2, 0}, {0.5, 0.1}, {0, 2}}), SizeIs(3));
  EXPECT_THAT(triangles_of({{0, 0}, {huge, -huge}, {-huge, huge}, {0.5, 0.1}, {0, huge}}),
              SizeIs(3));
}

}  // namespace
}  // namespace lapwing
