#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kernels/turned_rings.h"
#include "kernels/twins.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::fit;
using test::Fitted;
using test::Sample;
using test::TurnedRings;

class EnergyGradient : public test::KernelTest {
 protected:
  static Fitted stretched_fit(Kernels& on, const TurnedRings& turned) {
    return fit(on, turned, test::different_stretches(turned.rings.row_count()));
  }
};

// Returns the gradient in the order of the sum in the energy: each row adds its terms to the
// vertices of its one-ring.
std::vector<double> scattered(const TurnedRings& turned, const std::vector<Matrix3d>& T) {
  const RegionRings& rings = turned.rings;
  std::vector<Vector3d> sum(rings.vertices.size(), Vector3d::Zero());
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    const Vector3d row =
        rings.row_weights[r] * (turned.moved_laplacian(r) - T[r] * turned.rest_laplacian(r));
    sum[r] += row;
    for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
      const Index j = rings.neighbours[e];
      sum[j] -= rings.weights[e] * row;
      if (rings.stiffness.empty()) continue;
      const Vector3d pull = rings.stiffness[e] * (T[r] * rings.edges[e] - turned.moved_edge(r, e));
      sum[r] += pull;
      sum[j] -= pull;
    }
  }
  const std::size_t n = rings.unknown_rows.size();
  std::vector<double> g(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      g[axis * n + k] = sum[rings.unknown_rows[k]][static_cast<Eigen::Index>(axis)];
    }
  }
  return g;
}

double longest_edge(const TurnedRings& turned) {
  double size = 1e-300;
  for (const Vector3d& edge : turned.rings.edges) size = std::max(size, edge.norm());
  return size;
}

TEST_P(EnergyGradient, GathersWhatEveryRowScatters) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double mu : {0.0, 0.7}) {
      const TurnedRings turned = test::turned_rings(sample, 100, 0.2, mu, 11);
      const Fitted result = stretched_fit(*kernels, turned);
      const std::vector<double> expected = scattered(turned, result.transforms);
      for (std::size_t k = 0; k < expected.size(); ++k) {
        EXPECT_NEAR(result.gradient[k], expected[k],
                    100.0 * GetParam().tolerance * longest_edge(turned))
            << sample.name << " mu " << mu;
      }
    }
  }
}

// The rotations are optimal, so their derivatives do not contribute to the gradient.
TEST(EnergyGradientOnTheCpu, IsHalfOfTheChangeOfTheEnergy) {
  CpuKernels kernels;
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 15));
  TurnedRings turned = test::turned_rings(sample, 40, 0.3, 0.3, 16);
  const std::vector<Matrix3d> stretch = test::different_stretches(turned.rings.row_count());
  const auto rotations = kernels.make_ring_rotations(std::make_shared<RegionRings>(turned.rings));
  const auto energy = [&] { return fit(*rotations, turned, stretch).energy(); };
  const std::size_t n = turned.rings.unknown_rows.size();
  const std::vector<double> g = fit(*rotations, turned, stretch).gradient;
  constexpr double kStep = 1e-5;
  for (std::size_t k = 0; k < n; k += 5) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double& coordinate =
          turned.displacement[turned.rings.unknown_rows[k]][static_cast<Eigen::Index>(axis)];
      const double at = coordinate;
      coordinate = at + kStep;
      const double above = energy();
      coordinate = at - kStep;
      const double below = energy();
      coordinate = at;
      EXPECT_NEAR(2.0 * g[axis * n + k], (above - below) / (2.0 * kStep), 1e-7);
    }
  }
}

// The tested motion is v' = s R v + t, and the rest stretch is s I.
TEST_P(EnergyGradient, IsNothingWithTheEnergyForRigidMotionsAndSimilaritiesOfThatScale) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double scale : {1.0, 0.4, 2.5}) {
      TurnedRings turned = test::turned_rings(sample, 0, 0.0, 0.5, 17);
      const Vector3d center = bounds_of(sample.mesh.positions).center();
      const double size = longest_edge(turned);
      const Matrix3d T =
          scale *
          Eigen::AngleAxisd(0.6 * std::numbers::pi, test::turning_axis()).toRotationMatrix();
      for (std::size_t v = 0; v < turned.displacement.size(); ++v) {
        const Vector3d arm = sample.mesh.positions[turned.rings.vertices[v]] - center;
        turned.displacement[v] = T * arm - arm + size * Vector3d(2, -1, 3);
      }
      const Fitted fitted =
          fit(*kernels, turned,
              std::vector<Matrix3d>(turned.rings.row_count(), scale * Matrix3d::Identity()));
      const double tolerance = 100.0 * GetParam().tolerance * size;
      for (const double energy : fitted.energies) {
        EXPECT_GE(energy, 0.0);
        EXPECT_LE(energy, tolerance * tolerance) << sample.name << " scale " << scale;
      }
      for (const double g : fitted.gradient) {
        EXPECT_LE(std::abs(g), tolerance) << sample.name << " scale " << scale;
      }
    }
  }
}

TEST_P(EnergyGradient, RepeatsBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 13));
  const TurnedRings turned = test::turned_rings(sample, 100, 0.3, 0.1, 14);
  EXPECT_EQ(stretched_fit(*kernels, turned).gradient, stretched_fit(*kernels, turned).gradient);
}

LAPWING_ON_ALL_TWINS(EnergyGradient);

}  // namespace
}  // namespace lapwing
