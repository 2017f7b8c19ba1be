// Where settling starts, and that it does not end early because of it.
#include <array>

#include <gtest/gtest.h>

#include "lapwing/deform/deform_request.h"
#include "lapwing/deform/deformer.h"
#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/settle/settle.h"
#include "support/linear_options.h"
#include "support/rippled_cylinder.h"

namespace lapwing {
namespace {

using Eigen::Affine3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

class StartOfSettling : public ::testing::Test {
 protected:
  StartOfSettling(Mesh mesh, EditRegion region)
      : mesh_(std::move(mesh)), topology_(mesh_.topology()), region_(std::move(region)) {}

  struct Outcome {
    std::vector<Vector3d> u;
    SettleResult result;
    int times_asked = 0;
  };

  // By the n x n factor alone, from where that takes the surface.
  Outcome settle(const Affine3d& motion, const BetterStart& better) const {
    StageTimings timings;
    const Constraints constraints = constraints_of(region_, topology_, 1.0, false);
    const SystemPattern pattern(topology_, region_.roi, constraints.unknowns);
    const LaplacianSystem system(mesh_.positions, topology_, region_.roi, constraints, pattern,
                                 {LaplacianWeights::cotangent, kDefaultDetailLength}, timings);
    const std::size_t n = system.size();
    std::vector<Vector3d> wanted(mesh_.vertex_count(), Vector3d::Zero());
    for (const Index v : region_.handles[0])
      wanted[v] = motion * mesh_.positions[v] - mesh_.positions[v];
    std::vector<double> x(3 * n);
    system.right_hand_side(wanted, x);
    system.solve_in_place(x, 3);
    Outcome outcome{std::vector<Vector3d>(mesh_.vertex_count(), Vector3d::Zero()), {}};
    for (std::size_t k = 0; k < n; ++k) {
      outcome.u[constraints.unknowns.vertices[k]] = {x[k], x[n + k], x[2 * n + k]};
    }
    CpuKernels kernels;
    Settler settler(kernels, system, {.tolerance = 1e-4, .max_iterations = 1000});
    const auto asked = [&](std::span<Vector3d> u) {
      ++outcome.times_asked;
      return better(u);
    };
    outcome.result =
        settler.settle({wanted, {}}, outcome.u, {}, better ? BetterStart(asked) : BetterStart());
    return outcome;
  }

  BetterStart linear(const Affine3d& motion) const {
    return [this, motion](std::span<Vector3d> u) {
      CpuKernels kernels;
      const Deformer deformer(mesh_.positions, topology_, region_, test::linear_options(), kernels);
      const Positions there = deformer.solve(std::array{motion}).positions;
      for (std::size_t v = 0; v < u.size(); ++v) u[v] = there[v] - mesh_.positions[v];
      return true;
    };
  }

  double largest_distance(std::span<const Vector3d> a, std::span<const Vector3d> b) const {
    double largest = 0.0;
    for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, (a[v] - b[v]).norm());
    return largest;
  }

  const Mesh mesh_;
  const Topology topology_;
  const EditRegion region_;
};

class LongTube : public StartOfSettling {
 protected:
  LongTube()
      : StartOfSettling(test::rippled_cylinder(),
                        test::ends_of_cylinder(test::rippled_cylinder())) {}
};

// Held all around.
class Sheet : public StartOfSettling {
 protected:
  Sheet() : StartOfSettling(grid(kSide, kSide), middle()) {}

 private:
  static constexpr Index kSide = 30;
  static EditRegion middle() {
    EditRegion region;
    region.handles.resize(1);
    for (Index v = 0; v < (kSide + 1) * (kSide + 1); ++v) {
      const auto [row, column] = std::pair(v / (kSide + 1), v % (kSide + 1));
      const auto is_at = [](Index k) { return k == 0 || k == kSide; };
      const auto is_in = [](Index k) { return k > kSide / 3 && k < 2 * kSide / 3; };
      region.roi.push_back(v);
      if (is_at(row) || is_at(column)) region.belt.push_back(v);
      if (is_in(row) && is_in(column)) region.handles[0].push_back(v);
    }
    return region;
  }
};

TEST_F(LongTube, PushedAsideStartsFromTheLinearResponseAndSettlesInFewerIterations) {
  const Affine3d aside(Translation3d(0.6, 0.0, 0.0));
  const Outcome without = settle(aside, {});
  const Outcome with = settle(aside, linear(aside));
  EXPECT_EQ(with.times_asked, 1);
  EXPECT_TRUE(without.result.settled);
  EXPECT_TRUE(with.result.settled);
  EXPECT_LT(with.result.iterations, without.result.iterations);
  EXPECT_NEAR(with.result.energy, without.result.energy, 1e-3 * without.result.energy);
}

TEST_F(Sheet, HeldAllAroundDoesNotAsk) {
  const Affine3d lifted(Translation3d(0.0, 0.0, 0.3));
  const Outcome outcome = settle(lifted, linear(lifted));
  EXPECT_EQ(outcome.times_asked, 0);
  EXPECT_TRUE(outcome.result.settled);
  EXPECT_GT(outcome.result.iterations, 2);
}

TEST_F(LongTube, StartThatIsWorseOrNoneChangesNothing) {
  const Affine3d aside(Translation3d(0.6, 0.0, 0.0));
  const Outcome expected = settle(aside, {});
  const Outcome worse = settle(aside, [](std::span<Vector3d> u) {
    for (std::size_t v = 0; v < u.size(); ++v) u[v].y() += v % 2 == 0 ? 0.1 : -0.1;
    return true;
  });
  const Outcome none = settle(aside, [](std::span<Vector3d>) { return false; });
  for (const Outcome* outcome : {&worse, &none}) {
    EXPECT_EQ(outcome->times_asked, 1);
    EXPECT_EQ(outcome->result.iterations, expected.result.iterations);
    EXPECT_LT(largest_distance(outcome->u, expected.u), 1e-12);
  }
}

// The n x n factor holds every ring in its turn: where a whole limb has far to go, a step by it is
// soon shorter than the tolerance.
TEST_F(LongTube, IsSettledToItsToleranceHoweverLittleItsEndMoves) {
  CpuKernels kernels;
  DeformOptions options = DeformParameters{};
  DeformOptions to_the_end = options;
  to_the_end.settle = SettleOptions{.tolerance = 1e-9, .max_iterations = 1000};
  const Deformer deformer(mesh_.positions, topology_, region_, options, kernels);
  const Deformer reference(mesh_.positions, topology_, region_, to_the_end, kernels);
  double edges = 0.0;
  for (std::size_t v = 0; v < mesh_.vertex_count(); ++v) {
    for (const Index j : topology_.rings[static_cast<Index>(v)]) {
      edges += (mesh_.positions[v] - mesh_.positions[j]).norm();
    }
  }
  const double mean_edge = edges / static_cast<double>(topology_.rings.values.size());
  for (const double by : {1e-5, 1e-4, 3e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    const std::array aside{Affine3d(Translation3d(6.0 * by, 0.0, 0.0))};
    EXPECT_LE(largest_distance(deformer.solve(aside).positions, reference.solve(aside).positions),
              options.settle->tolerance * mean_edge)
        << by;
  }
}

}  // namespace
}  // namespace lapwing
