#include "lapwing/parameterize/symmetric_dirichlet.h"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "lapwing/parameterize/planar.h"
#include "parameterize/planar_domains.h"

namespace lapwing {
namespace {

using Eigen::Vector2d;

// Inner vertices moved about by up to `share` of an edge.
std::vector<Vector2d> shaken(const PlanarDomain& domain, double reach) {
  std::vector<Vector2d> points = domain.points;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-reach, reach);
  for (Vector2d& p : points) {
    const double dx = shift(random);
    const double dy = shift(random);
    p += Vector2d(dx, dy);
  }
  return points;
}

Eigen::VectorXd gradient(const SymmetricDirichlet& energy, const PlanarDomain& domain,
                         const std::vector<Vector2d>& points) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t t = 0; t < domain.triangles.size(); ++t) {
    const SymmetricDirichlet::Part part = energy.part(t, points);
    for (int k = 0; k < 3; ++k) {
      sum.segment<2>(2 * domain.triangles[t][static_cast<std::size_t>(k)]) +=
          part.gradient.segment<2>(2 * k);
    }
  }
  return sum;
}

TEST(SymmetricDirichlet, IsTwoAtRestAndUnderRotationsAndMoreElsewhere) {
  const PlanarDomain disk = disk_of_rings(6);
  const SymmetricDirichlet energy(disk.triangles, disk.points);
  EXPECT_NEAR(energy.energy(disk.points), 2.0, 1e-13);
  std::vector<Vector2d> turned = disk.points;
  for (Vector2d& p : turned)
    p = Vector2d(0.6 * p.x() - 0.8 * p.y() + 3.0, 0.8 * p.x() + 0.6 * p.y());
  EXPECT_NEAR(energy.energy(turned), 2.0, 1e-12);
  EXPECT_GT(energy.energy(shaken(disk, 0.01)), 2.001);
  EXPECT_LT(gradient(energy, disk, disk.points).norm(), 1e-13);
}

TEST(SymmetricDirichlet, IsThatOfTheSingularValues) {
  const PlanarDomain square = square_grid(3);
  const SymmetricDirichlet energy(square.triangles, square.points);
  std::vector<Vector2d> stretched = square.points;
  for (Vector2d& p : stretched) p = Vector2d(2.0 * p.x(), 0.5 * p.y());
  EXPECT_NEAR(energy.energy(stretched), 0.5 * (4.0 + 0.25 + 0.25 + 4.0), 1e-12);
}

TEST(SymmetricDirichlet, IsInfiniteWhereATriangleIsFlatOrTurnedOver) {
  PlanarDomain disk = disk_of_rings(2);
  const SymmetricDirichlet energy(disk.triangles, disk.points);
  disk.points[0] = disk.points[1];
  EXPECT_TRUE(std::isinf(energy.energy(disk.points)));
  disk.points[0] = 1.5 * disk.points[1];
  EXPECT_TRUE(std::isinf(energy.energy(disk.points)));
}

TEST(SymmetricDirichlet, GradientIsTheSlopeOfTheEnergy) {
  const PlanarDomain square = square_grid(4);
  const SymmetricDirichlet energy(square.triangles, square.points);
  const std::vector<Vector2d> points = shaken(square, 0.05);
  ASSERT_TRUE(is_bijective(square.triangles, points));
  const Eigen::VectorXd slopes = gradient(energy, square, points);
  constexpr double kStep = 1e-6;
  for (std::size_t v = 0; v < points.size(); ++v) {
    for (const int c : {0, 1}) {
      std::vector<Vector2d> ahead = points;
      std::vector<Vector2d> behind = points;
      ahead[v][c] += kStep;
      behind[v][c] -= kStep;
      const double slope = (energy.energy(ahead) - energy.energy(behind)) / (2.0 * kStep);
      EXPECT_NEAR(slopes[2 * static_cast<Eigen::Index>(v) + c], slope, 1e-7);
    }
  }
}

// Where nothing has to be projected away, the Hessian is the slope of the gradient.
TEST(SymmetricDirichlet, HessianIsTheProjectedSlopeOfTheGradient) {
  const PlanarDomain square = square_grid(4);
  const SymmetricDirichlet energy(square.triangles, square.points);
  const std::vector<Vector2d> points = shaken(square, 0.05);
  constexpr double kStep = 1e-6;
  int projected = 0;
  for (std::size_t t = 0; t < square.triangles.size(); ++t) {
    Eigen::Matrix<double, 6, 6> slopes;
    for (int column = 0; column < 6; ++column) {
      std::vector<Vector2d> ahead = points;
      std::vector<Vector2d> behind = points;
      const Index v = square.triangles[t][static_cast<std::size_t>(column / 2)];
      ahead[v][column % 2] += kStep;
      behind[v][column % 2] -= kStep;
      slopes.col(column) =
          (energy.part(t, ahead).gradient - energy.part(t, behind).gradient) / (2.0 * kStep);
    }
    using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
    const auto hessian = energy.part(t, points).hessian;
    EXPECT_GT(Solver(hessian).eigenvalues()[0], -1e-12);
    // The projection acts on the eigenvalues by J, not by the corners: the same where none is
    // negative.
    if (Solver(slopes).eigenvalues()[0] > -1e-7) {
      EXPECT_LT((hessian - slopes).norm(), 1e-6 * slopes.norm());
    } else {
      ++projected;
      EXPECT_GT(Solver(hessian - slopes).eigenvalues()[0], -1e-6 * slopes.norm());
    }
  }
  EXPECT_GT(projected, 0);
  EXPECT_LT(projected, static_cast<int>(square.triangles.size()));
}

}  // namespace
}  // namespace lapwing
