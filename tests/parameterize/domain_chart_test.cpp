#include "lapwing/parameterize/domain_chart.h"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "parameterize/planar_domains.h"
#include "support/error_message.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

DomainChart chart_of(const PlanarDomain& domain) {
  return {domain.boundary, domain.points};
}

TEST(DomainChart, BoundaryGoesToTheCircle) {
  for (const PlanarDomain& domain : {disk_of_rings(5), square_grid(7)}) {
    const DomainChart chart = chart_of(domain);
    for (const Index v : domain.boundary) {
      const auto [z, clearance] = chart.place(domain.points[v]);
      EXPECT_NEAR(z.norm(), 1.0, 1e-14);
      EXPECT_NEAR(clearance, 0.0, 1e-14);
    }
  }
}

TEST(DomainChart, ClearanceIsOneLessTheSquaredRadius) {
  for (const PlanarDomain& domain : {disk_of_rings(9), square_grid(16)}) {
    const DomainChart chart = chart_of(domain);
    for (const Vector2d& p : domain.points) {
      const auto [z, clearance] = chart.place(p);
      EXPECT_NEAR(clearance, 1.0 - z.squaredNorm(), 1e-14);
    }
  }
}

// The Cauchy-Riemann equations, by central differences.
TEST(DomainChart, SquareIsLaidOutConformally) {
  const DomainChart chart = chart_of(square_grid(2));
  constexpr double kStep = 1e-5;
  for (const Vector2d& p : {Vector2d(0.5, 0.5), Vector2d(0.7, 0.6), Vector2d(0.93, 0.9)}) {
    const auto slope = [&](const Vector2d& direction) {
      return Vector2d(
          (chart.place(p + kStep * direction).z - chart.place(p - kStep * direction).z) /
          (2.0 * kStep));
    };
    const Vector2d along_x = slope({1.0, 0.0});
    const Vector2d along_y = slope({0.0, 1.0});
    EXPECT_NEAR(along_y.x(), -along_x.y(), 1e-8);
    EXPECT_NEAR(along_y.y(), along_x.x(), 1e-8);
    EXPECT_GT(along_x.norm(), 0.1);
  }
}

TEST(DomainChart, OtherShapesAreRefused) {
  const std::vector<Vector2d> kite{{0.0, -1.0}, {1.0, 0.0}, {0.0, 2.0}, {-0.5, 0.0}};
  EXPECT_THAT(error_message<InputError>([&] {
                DomainChart(std::array<Index, 4>{0, 1, 2, 3}, kite);
              }),
              testing::HasSubstr("neither a circle nor an axis-aligned rectangle"));
  EXPECT_THAT(error_message<InputError>([&] {
                DomainChart(std::array<Index, 2>{0, 1}, kite);
              }),
              testing::HasSubstr("has 2 vertices"));
}

}  // namespace
}  // namespace lapwing
