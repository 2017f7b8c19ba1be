#include "lapwing/deform/pose_tangent.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lapwing/deform/edit_system.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// What is prepared beside a drag may have another order of elimination: the same system all the
// same.
TEST(PoseTangent, SolvesTheSameSystemWhenItIsPrepared) {
  const Mesh sheet = grid(40, 40);
  EditRegion region;
  region.handles.resize(1);
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    region.roi.push_back(v);
    if (v % 41 < 3) region.belt.push_back(v);
    if (v % 41 > 37) region.handles[0].push_back(v);
  }
  CpuKernels kernels;
  PreparedRegion prepared(sheet.topology());
  DeformOptions options;
  options.settle = SettleOptions();
  const EditSystem edit(prepared, sheet.positions, region, options, Progress{});
  const LaplacianSystem& system = edit.systems->laplacian_with_rings();

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
    PoseTangent tangent(sheet.topology(), region.roi, edit.systems->pattern(), system, options,
                        [&] { return edit.tangent_rows(kernels); });
    if (is_prepared) tangent.prepare();
    EXPECT_TRUE(tangent.turn(transforms, displacement));
    std::vector<double> x(3 * system.size());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = static_cast<double>(k % 13) - 6.0;
    tangent.solve_in_place(x);
    return x;
  };
  const std::vector<double> expected = solution(false);
  const std::vector<double> actual = solution(true);
  ASSERT_FALSE(edit.systems->pattern().is_dissected());
  EXPECT_NE(actual, expected) << "in the same order";
  double largest = 0;
  for (const double x : expected) largest = std::max(largest, std::abs(x));
  EXPECT_GT(largest, 0.0);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    ASSERT_NEAR(actual[k], expected[k], 1e-2 * largest) << "unknown " << k;
  }
}

// A sheet of so many quads a side, held at its corners and its middle by `weight`: all that holds
// it pulls it up by 1, which it gives in to.
void expect_sheet_gives_in(Index side, double weight) {
  SCOPED_TRACE(weight);
  const Mesh sheet = grid(side, side);
  const Index row = side + 1;
  EditRegion region;
  region.handles.push_back({row * row / 2});
  for (Index v = 0; v < sheet.vertex_count(); ++v) region.roi.push_back(v);
  region.belt = {0, row - 1, row * (row - 1), row * row - 1};
  CpuKernels kernels;
  PreparedRegion prepared(sheet.topology());
  DeformOptions options;
  options.settle = SettleOptions();
  options.constraint_weight = weight;
  const EditSystem edit(prepared, sheet.positions, region, options, Progress{});
  const LaplacianSystem& system = edit.systems->laplacian_with_rings();
  const std::size_t n = system.size();
  PoseTangent tangent(sheet.topology(), region.roi, edit.systems->pattern(), system, options,
                      [&] { return edit.tangent_rows(kernels); });
  const std::vector<Matrix3d> transforms(n, Matrix3d::Identity());
  const std::vector<Vector3d> displacement(n, Vector3d::Zero());
  ASSERT_TRUE(tangent.turn(transforms, displacement));
  std::vector<double> x(3 * n, 0.0);
  for (std::size_t k = 0; k < n; ++k) {
    x[2 * n + k] = system.constraints().W[static_cast<std::size_t>(system.elimination_order()[k])];
  }
  tangent.solve_well_in_place(x);
  for (std::size_t k = 0; k < n; ++k) ASSERT_NEAR(x[2 * n + k], 1.0, 0.05) << "unknown " << k;
}

// Where next to nothing holds a sheet floats find its translations far too stiff.
TEST(PoseTangent, IsRefinedToWhatDoublesSolve) {
  for (const double weight : {1.0, 1e-3, 1e-4, 5e-5}) expect_sheet_gives_in(40, weight);
}

TEST(PoseTangent, IsFactoredInDoublesWhereFloatsLeaveItIndefinite) {
  expect_sheet_gives_in(6, 1e-4);
}

}  // namespace
}  // namespace lapwing
