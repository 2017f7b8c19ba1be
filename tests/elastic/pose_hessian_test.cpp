#include "lapwing/elastic/pose_hessian.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/deform/edit_system.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct PreparedEdit {
  PreparedEdit(const Mesh& mesh, EditRegion edit_region, double weight = 1.0)
      : prepared(mesh.topology()),
        edit(prepared, mesh.positions, std::move(edit_region), with_weight(weight), Progress{}) {}
  static DeformOptions with_weight(double weight) {
    DeformOptions options;
    options.constraint_weight = weight;
    return options;
  }
  PoseHessian hessian() {
    return {edit.topology, edit.region.roi, edit.factors->pattern(),
            system,        edit.options,    [this] { return edit.tangent_rows(kernels); }};
  }

  CpuKernels kernels;
  PreparedRegion prepared;
  const EditSystem edit;
  const LaplacianSystem& system = *edit.laplacian;
};

TEST(PoseHessian, SolvesToTheSameBitsWhenItIsPrepared) {
  const Mesh sheet = grid(40, 40);
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (v % 41 < 3) region.belt.push_back(v);
    if (v % 41 > 37) region.handles[0].push_back(v);
  }
  PreparedEdit edit(sheet, region);
  const LaplacianSystem& system = edit.system;

  const RegionRings& rings = system.rings();
  std::vector<Matrix3d> transforms;
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    transforms.emplace_back(
        Eigen::AngleAxisd(0.01 * static_cast<double>(r % 70), Vector3d::UnitX()));
  }
  std::vector<Vector3d> displacement;
  for (const Index v : rings.vertices) {
    displacement.emplace_back(sheet.positions[v].x() * Vector3d(0, 0.1, 0.5));
  }
  const auto solution = [&](bool is_prepared) {
    PoseHessian hessian = edit.hessian();
    if (is_prepared) hessian.prepare();
    EXPECT_TRUE(hessian.factorize(transforms, displacement));
    std::vector<double> x(3 * system.size());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<double>(k % 13) - 6.0;
    hessian.solve_in_place(x);
    return x;
  };
  EXPECT_EQ(solution(true), solution(false));
}

// The sheet has `side` x `side` quads. Soft constraints of this weight at its corners and its
// middle pull it up by 1, so the whole sheet must move up by 1.
void expect_sheet_gives_in(Index side, double weight) {
  SCOPED_TRACE(weight);
  const Mesh sheet = grid(side, side);
  const Index row = side + 1;
  EditRegion region;
  region.handles.push_back({row * row / 2});
  for (Index v = 0; v < sheet.vertex_count(); ++v) region.roi.push_back(v);
  region.belt = {0, row - 1, row * (row - 1), row * row - 1};
  PreparedEdit edit(sheet, region, weight);
  const LaplacianSystem& system = edit.system;
  const std::size_t n = system.size();
  PoseHessian hessian = edit.hessian();
  const std::vector<Matrix3d> transforms(n, Matrix3d::Identity());
  const std::vector<Vector3d> displacement(n, Vector3d::Zero());
  ASSERT_TRUE(hessian.factorize(transforms, displacement));
  std::vector<double> x(3 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    x[2 * n + k] = system.constraints().W[static_cast<std::size_t>(system.elimination_order()[k])];
  }
  hessian.solve_accurately_in_place(x);
  for (std::size_t k = 0; k < n; ++k) ASSERT_NEAR(x[2 * n + k], 1.0, 0.05) << "unknown " << k;
}

// If the pose equals the stretched and rotated rest shape, the energy is 0, and the matrix equals
// the Hessian of E up to a relative error of 0.001.
TEST(PoseHessian, IsTheHessianOfAStretchedPose) {
  const Mesh tube = test::bumpy_tube();
  PreparedEdit edit(tube, test::foot_and_head(tube));
  const LaplacianSystem& system = edit.system;
  const std::size_t n = system.size();
  PoseHessian hessian = edit.hessian();
  EnergyMinimizer settler(edit.kernels, system, SettleOptions());

  const Eigen::AngleAxisd tilt(0.6, Vector3d(1.0, 2.0, -1.0).normalized());
  const Matrix3d S = tilt * Vector3d(1.6, 0.8, 1.1).asDiagonal() * tilt.inverse();
  const Matrix3d T = Eigen::AngleAxisd(1.1, Vector3d(2.0, -1.0, 1.0).normalized()) * S;
  const std::vector<Matrix3d> stretch(tube.vertex_count(), S);
  std::vector<Vector3d> u;
  for (const Vector3d& p : tube.positions) u.emplace_back(T * p - p);
  const MinimizerTarget target{u, stretch};
  std::vector<Vector3d> displacement;
  for (const Index v : system.rings().vertices) displacement.push_back(u[v]);
  ASSERT_TRUE(hessian.factorize(std::vector(system.rings().row_count(), T), displacement));

  const auto vertex = [&](std::size_t k) {
    const auto unknown = static_cast<std::size_t>(system.elimination_order()[k]);
    return system.constraints().unknowns.vertices[unknown];
  };
  std::vector<double> p(3 * n);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = std::sin(static_cast<double>(i * i));
  constexpr double kStep = 1e-6;
  std::vector<double> product(3 * n, 0.0);
  for (const double side : {1.0, -1.0}) {
    std::vector<Vector3d> moved = u;
    for (std::size_t k = 0; k < n; ++k) {
      moved[vertex(k)] += side * kStep * Vector3d(p[k], p[n + k], p[2 * n + k]);
    }
    settler.energy(target, moved);
    std::vector<Vector3d> gradient(tube.vertex_count(), Vector3d::Zero());
    settler.gradient(gradient);
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        product[axis * n + k] +=
            side / (2.0 * kStep) * gradient[vertex(k)][static_cast<Eigen::Index>(axis)];
      }
    }
  }
  hessian.solve_accurately_in_place(product);
  double off = 0.0;
  double size = 0.0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    off += (product[i] - p[i]) * (product[i] - p[i]);
    size += p[i] * p[i];
  }
  EXPECT_LT(std::sqrt(off / size), 0.02);
}

// In single precision, a weakly constrained sheet would be far too stiff under translation.
TEST(PoseHessian, IsRefinedToWhatDoublesSolve) {
  for (const double weight : {1.0, 1e-3, 1e-4, 5e-5}) expect_sheet_gives_in(40, weight);
}

TEST(PoseHessian, IsFactoredInDoublesWhereFloatsLeaveItIndefinite) {
  expect_sheet_gives_in(6, 1e-4);
}

}  // namespace
}  // namespace lapwing
