#include "lapwing/parameterize/radial_basis_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "parameterize/planar_domains.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

TEST(RadialBasisField, TakesItsValuesAtTheCentresAndVanishesOnTheBoundary) {
  const std::array<Vector2d, 4> centres{Vector2d(0.3, 0.4), Vector2d(0.301, 0.4),
                                        Vector2d(0.97, 0.5), Vector2d(0.1, 0.9)};
  const std::array<Vector2d, 4> values{Vector2d(0.1, 0.0), Vector2d(0.1, 0.001),
                                       Vector2d(-0.2, 0.3), Vector2d(0.0, 0.0)};
  const PlanarDomain square = square_grid(10);
  const DomainChart chart(square.boundary, square.points);
  const RadialBasisField field(chart, centres, values);
  for (std::size_t k = 0; k < centres.size(); ++k) {
    EXPECT_LT((field.at(centres[k]) - values[k]).norm(), 1e-12);
  }
  for (const Index v : square.boundary) EXPECT_LT(field.at(square.points[v]).norm(), 1e-13);
}

// phi(s) by the formula in extended precision, along a radius of the disk.
TEST(RadialBasisField, OneCentreSpreadsAsTheFormulaSays) {
  const PlanarDomain disk = disk_of_rings(8);
  const DomainChart chart(disk.boundary, disk.points);
  const RadialBasisField field(chart, std::array{Vector2d(0.0, 0.0)},
                               std::array{Vector2d(1.0, -2.0)});
  for (double r = 0.01; r < 0.999; r += 0.01) {
    const long double s =
        static_cast<long double>(r) * r / (1.0L - static_cast<long double>(r) * r);
    const auto phi = static_cast<double>(1.0L - s * std::log1p(1.0L / s));
    const Vector2d value = field.at({r * std::cos(3.0 * r), r * std::sin(3.0 * r)});
    EXPECT_NEAR(value.x(), phi, 1e-12);
    EXPECT_NEAR(value.y(), -2.0 * phi, 1e-12);
  }
}

TEST(RadialBasisField, NothingMovesFartherThanTheOnlyCentre) {
  const PlanarDomain square = square_grid(30);
  const DomainChart chart(square.boundary, square.points);
  for (const Vector2d& centre : {Vector2d(0.5, 0.5), Vector2d(0.98, 0.5), Vector2d(0.95, 0.97)}) {
    const RadialBasisField field(chart, std::array{centre}, std::array{Vector2d(0.6, 0.8)});
    for (const Vector2d& p : square.points) EXPECT_LE(field.at(p).norm(), 1.0 + 1e-15);
  }
}

}  // namespace
}  // namespace lapwing
