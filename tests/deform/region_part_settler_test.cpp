#include "lapwing/deform/region_part_settler.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "lapwing/base/errors.h"
#include "lapwing/deform/deform.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/deform/pose_tangent.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "support/bent_tube.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;

// A bent tube where the linear response leaves it, and a patch of its side.
class PartOfATube : public ::testing::TestWithParam<bool> {
 protected:
  explicit PartOfATube(std::vector<Target> targets = {}) {
    EditRegion region = test::foot_and_head(mesh_);
    region.targets = std::move(targets);
    region.hard_targets = GetParam();
    DeformOptions options;
    options.hard = GetParam();
    edit_ =
        std::make_unique<const EditSystem>(prepared_, mesh_.positions, region, options, Progress{});
    const LaplacianSystem& system = edit_->systems->laplacian_with_rings();
    settler_ = std::make_unique<Settler>(kernels_, system, SettleOptions{});
    std::vector<double> q(edit_->column_count());
    edit_->set_parameters(std::vector{test::bend()}, q);
    wanted_ = edit_->asked_displacement(q);
    const Deformer linear(mesh_.positions, mesh_.topology(), region, linear_options(options),
                          kernels_);
    u_ = linear.solve(std::vector{test::bend()}).positions;
    for (Index v = 0; v < u_.size(); ++v) u_[v] -= mesh_.positions[v];
    // Into the handle, which is soft, and across the target.
    for (Index v = 150; v < 230; ++v) {
      if (edit_->constraints.unknowns.of_vertex[v] != kNoIndex) part_.push_back(v);
    }
  }

  static DeformOptions linear_options(DeformOptions options) {
    options.settle.reset();
    return options;
  }
  SettleTarget target() const { return {wanted_, stretch_}; }
  double energy() { return settler_->energy(target(), u_); }

  const Mesh mesh_ = test::bumpy_tube();
  const std::vector<Eigen::Matrix3d> stretch_ =
      std::vector<Eigen::Matrix3d>(mesh_.vertex_count(), 1.05 * Eigen::Matrix3d::Identity());
  CpuKernels kernels_;
  PreparedRegion prepared_{mesh_.topology()};
  std::unique_ptr<const EditSystem> edit_;
  std::unique_ptr<Settler> settler_;
  std::vector<Vector3d> wanted_;
  std::vector<Vector3d> u_;
  std::vector<Index> part_;
};

class PartOfADrawnTube : public PartOfATube {
 protected:
  PartOfADrawnTube()
      : PartOfATube({{.corners = {160, 160, 160},
                      .shares = {1.0, 0.0, 0.0},
                      .position = Vector3d(0.9, 0.2, 2.2),
                      .weight = 3.0},
                     {.corners = {148, 149, 160},
                      .shares = {0.3, 0.3, 0.4},
                      .position = Vector3d(-0.6, 0.5, 2.0),
                      .weight = 2.0}}) {}
};

// No vertex of the part can be moved to less energy, none else has been moved.
#define EXPECT_PART_IS_SETTLED()                                                       \
  const std::vector<Vector3d> before = u_;                                             \
  const double energy_before = energy();                                               \
  RegionPartSettler(*edit_).settle_part(part_, target(), u_, {}, {});                  \
  const double settled = energy();                                                     \
  EXPECT_LT(settled, energy_before);                                                   \
  for (Index v = 0; v < u_.size(); ++v) {                                              \
    if (std::binary_search(part_.begin(), part_.end(), v)) continue;                   \
    EXPECT_EQ(std::memcmp(&u_[v], &before[v], sizeof(Vector3d)), 0) << "vertex " << v; \
  }                                                                                    \
  for (const Index v : part_) {                                                        \
    for (const double change : {-1e-3, 1e-3}) {                                        \
      const Vector3d here = u_[v];                                                     \
      u_[v] += change * Vector3d(0.6, -0.3, 0.7);                                      \
      EXPECT_GT(energy(), settled) << "vertex " << v;                                  \
      u_[v] = here;                                                                    \
    }                                                                                  \
  }

TEST_P(PartOfATube, IsSettledWhileAllElseStays) {
  EXPECT_PART_IS_SETTLED();
}
TEST_P(PartOfADrawnTube, IsSettledByItsTargetsToo) {
  EXPECT_PART_IS_SETTLED();
}

TEST_P(PartOfATube, StopsWhenItMayNotGoOn) {
  const std::vector<Vector3d> before = u_;
  RegionPartSettler(*edit_).settle_part(part_, target(), u_, [](double) { return false; }, {});
  EXPECT_EQ(u_, before);
  const auto cancel = [](std::string_view, double) { return false; };
  EXPECT_THROW(RegionPartSettler(*edit_).settle_part(part_, target(), u_, {}, cancel), Cancelled);
  EXPECT_EQ(u_, before);
}

INSTANTIATE_TEST_SUITE_P(SoftAndHard, PartOfATube, ::testing::Bool());
INSTANTIATE_TEST_SUITE_P(SoftAndHard, PartOfADrawnTube, ::testing::Bool());

// A sheet held all over but in its middle, where two points are drawn past each other: it
// crumples there and nowhere else. Settled with parts and without the surface is the same, with
// parts sooner.
TEST(PartsOfAnEdit, SaveIterationsAndChangeNothing) {
  constexpr Index kSide = 101;
  const Mesh sheet = bumpy_plane(kSide - 1, 10, 0.03);
  EditRegion region;
  region.hard_targets = true;
  for (Index v = 0; v < sheet.vertex_count(); ++v) {
    region.roi.push_back(v);
    const Index row = v / kSide;
    const Index column = v % kSide;
    const bool is_far =
        std::max(std::abs(static_cast<int>(row) - 50), std::abs(static_cast<int>(column) - 50)) > 5;
    if (is_far && row % 4 == 0 && column % 4 == 0) region.belt.push_back(v);
  }
  constexpr Index kMiddle = 50 * kSide + 50;
  const double edge = (sheet.positions[1] - sheet.positions[0]).norm();
  for (const auto& [v, x] : {std::pair{kMiddle, 8.0}, std::pair{kMiddle + 4, -8.0}}) {
    region.targets.push_back({.corners = {v, v, v},
                              .shares = {1.0, 0.0, 0.0},
                              .position = sheet.positions[v] + edge * Vector3d(x, 0.5, 0.2 * x)});
  }
  CpuKernels kernels;
  PreparedRegion prepared(sheet.topology());
  DeformOptions options;
  options.detail_length = 0.01;
  options.settle = SettleOptions{.tolerance = 1e-6, .max_iterations = 3000};
  const EditSystem edit(prepared, sheet.positions, region, options, Progress{});
  const std::vector<Vector3d> wanted = edit.asked_displacement({});
  const LaplacianSystem& system = edit.systems->laplacian_with_rings();
  PoseTangent tangent(sheet.topology(), region.roi, edit.systems->pattern(), system, options,
                      [&] { return edit.tangent_rows(kernels); });
  RegionPartSettler parts(edit);

  const auto settle = [&](PartSettler* with) {
    std::vector<Vector3d> u(sheet.vertex_count(), Vector3d::Zero());
    for (const Target& target : region.targets) {
      u[target.corners[0]] = target.position - sheet.positions[target.corners[0]];
    }
    Settler settler(kernels, system, *options.settle, &tangent, with);
    const SettleResult result = settler.settle({wanted}, u);
    EXPECT_TRUE(result.settled);
    return std::pair(u, result.iterations);
  };
  const auto [with_parts, iterations] = settle(&parts);
  const auto [without, all_iterations] = settle(nullptr);
  EXPECT_LT(iterations, all_iterations);
  EXPECT_LT(test::largest_distance(with_parts, without), 1e-6);
}

}  // namespace
}  // namespace lapwing
