#include <numbers>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include "kernels/turned_rings.h"
#include "kernels/twins.h"
#include "lapwing/laplacian/rotation.h"
#include "lapwing/mesh/shapes.h"
#include "lapwing/vulkan/vulkan_ring_rotations.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::fit;
using test::Fitted;
using test::Sample;
using test::TurnedRings;

class FitRotations : public test::KernelTest {
 protected:
  double tolerance() const { return 10.0 * GetParam().tolerance; }
};

// Returns (sigma_2 + s sigma_3) / sigma_1, where s is the sign of det(H). The larger this ratio is,
// the better the moment H determines the rotation.
double firmness(const Matrix3d& H) {
  const Vector3d sigma = Eigen::JacobiSVD<Matrix3d>(H).singularValues();
  if (!(sigma[0] > 0.0)) return 0.0;
  return (sigma[1] + (H.determinant() < 0.0 ? -sigma[2] : sigma[2])) / sigma[0];
}

// Returns the energy of row r for the transform T.
double energy_of(const TurnedRings& turned, std::size_t r, const Matrix3d& T) {
  const RegionRings& rings = turned.rings;
  double energy = rings.row_weights[r] *
                  (turned.moved_laplacian(r) - T * turned.rest_laplacian(r)).squaredNorm();
  if (rings.stiffness.empty()) return energy;
  for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
    energy += rings.stiffness[e] * (turned.moved_edge(r, e) - T * rings.edges[e]).squaredNorm();
  }
  return energy;
}

// Returns the magnitude of the terms of the row's energy before they cancel. Rounding errors are
// relative to this magnitude.
double energy_scale(const TurnedRings& turned, std::size_t r, double scale) {
  const RegionRings& rings = turned.rings;
  const double laplacian =
      turned.moved_laplacian(r).norm() + scale * turned.rest_laplacian(r).norm();
  double sum = rings.row_weights[r] * laplacian * laplacian;
  if (rings.stiffness.empty()) return sum;
  for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
    const double edge = turned.moved_edge(r, e).norm() + scale * rings.edges[e].norm();
    sum += rings.stiffness[e] * edge * edge;
  }
  return sum;
}

TEST_P(FitRotations, AreProperAndTheBestThereAre) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double noise : {0.0, 0.3, 3.0}) {
      const TurnedRings turned = test::turned_rings(sample, 130, noise, 0.5, 1);
      const Fitted fitted = fit(*kernels, turned);
      for (std::size_t r = 0; r < turned.rings.row_count(); ++r) {
        const Matrix3d& R = fitted.transforms[r];
        EXPECT_LE((R.transpose() * R - Matrix3d::Identity()).norm(), tolerance())
            << sample.name << " row " << r;
        EXPECT_GT(R.determinant(), 0.0) << sample.name << " row " << r;
        const Matrix3d H = turned.covariance(r);
        const Matrix3d best = nearest_rotation(H);
        EXPECT_GE(R.cwiseProduct(H).sum(),
                  best.cwiseProduct(H).sum() - 10.0 * tolerance() * H.norm())
            << sample.name << " row " << r << " noise " << noise;
        if (firmness(H) > 0.1) {
          EXPECT_LE((R - best).norm(), 10.0 * tolerance()) << sample.name << " row " << r;
        }
      }
    }
  }
}

// If a one-ring is nearly collinear, the two largest eigenvalues of Horn's matrix are close, and
// each step of Newton's method only halves the error.
TEST_P(FitRotations, AreTheBestForThinRings) {
  for (const double thickness : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    Mesh mesh = test::rough_sphere(2, 0.2, 22);
    for (Vector3d& p : mesh.positions) p = Vector3d(p.x(), thickness * p.y(), thickness * p.z());
    const Sample sample("thin sphere", std::move(mesh));
    const TurnedRings turned = test::turned_rings(sample, 130, 0.0, 0.5, 23);
    const Fitted fitted = fit(*kernels, turned);
    double worst = 0.0;
    for (std::size_t r = 0; r < turned.rings.row_count(); ++r) {
      const Matrix3d H = turned.covariance(r);
      const Matrix3d less = nearest_rotation(H) - fitted.transforms[r];
      worst = std::max(worst, less.cwiseProduct(H).sum() / H.norm());
    }
    EXPECT_LE(worst, 10.0 * tolerance()) << "thickness " << thickness;
  }
}

TEST_P(FitRotations, FindTheRotationOfARigidMotionAndLeaveNoEnergy) {
  for (const double degrees : {0.0, 1e-3, 90.0, 179.9, 180.0}) {
    const Matrix3d R = Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, test::turning_axis())
                           .toRotationMatrix();
    for (const Sample& sample : test::awkward_meshes()) {
      const TurnedRings turned = test::turned_rings(sample, degrees, 0.0, 0.5, 2);
      const Fitted fitted = fit(*kernels, turned);
      for (std::size_t r = 0; r < turned.rings.row_count(); ++r) {
        double size = 0.0;
        for (std::size_t e = turned.rings.starts[r]; e < turned.rings.starts[r + 1]; ++e) {
          size += turned.rings.edges[e].squaredNorm();
        }
        // Far from the origin, the rounding of the displacement contributes to the energy.
        const double rounding = 1e-22 * bounds_of(sample.mesh.positions).max.squaredNorm();
        EXPECT_LE(fitted.energies[r], tolerance() * tolerance() * size + rounding)
            << sample.name << " row " << r;
        if (firmness(turned.covariance(r)) < 0.1) continue;
        EXPECT_LE((fitted.transforms[r] - R).norm(), 10.0 * tolerance() + 1e-9)
            << sample.name << " row " << r << " at " << degrees;
      }
    }
  }
}

TEST_P(FitRotations, EnergyIsWhatTheStretchedRotationLeaves) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 3));
  for (const double mu : {0.0, 0.7}) {
    const TurnedRings turned = test::turned_rings(sample, 70, 0.4, mu, 4);
    const std::vector<Matrix3d> stretch = test::different_stretches(turned.rings.row_count());
    const Fitted fitted = fit(*kernels, turned, stretch);
    for (std::size_t r = 0; r < turned.rings.row_count(); ++r) {
      const Matrix3d& T = fitted.transforms[r];
      EXPECT_NEAR((T.transpose() * T - stretch[r] * stretch[r]).norm(), 0.0, 20.0 * tolerance());
      EXPECT_GT(T.determinant(), 0.0);
      const double energy = energy_of(turned, r, T);
      EXPECT_NEAR(fitted.energies[r], energy, tolerance() * (energy + 1.0));
    }
  }
}

TEST_P(FitRotations, SlightlyTurnedOnesLeaveNoLessEnergy) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double mu : {0.0, 0.7}) {
      const TurnedRings turned = test::turned_rings(sample, 70, 0.4, mu, 19);
      const std::vector<Matrix3d> stretch = test::different_stretches(turned.rings.row_count());
      const Fitted fitted = fit(*kernels, turned, stretch);
      for (std::size_t r = 0; r < stretch.size(); ++r) {
        const double rounding = tolerance() * energy_scale(turned, r, stretch[r].norm());
        for (int k = 0; k < 6; ++k) {
          const Vector3d axis = (k < 3 ? 1.0 : -1.0) * Vector3d::Unit(k % 3);
          const Matrix3d other = Eigen::AngleAxisd(0.05, axis) * fitted.transforms[r];
          EXPECT_GE(energy_of(turned, r, other), fitted.energies[r] - rounding)
              << sample.name << " row " << r << " mu " << mu;
        }
      }
    }
  }
}

// The minimal energy is unique even if several rotations attain it.
TEST_P(FitRotations, LeaveTheEnergyThatTheCpuTwinFinds) {
  CpuKernels cpu;
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double mu : {0.0, 0.7}) {
      const TurnedRings turned = test::turned_rings(sample, 130, 0.3, mu, 20);
      const std::vector<Matrix3d> stretch = test::different_stretches(turned.rings.row_count());
      const Fitted expected = fit(cpu, turned, stretch);
      const Fitted got = fit(*kernels, turned, stretch);
      for (std::size_t r = 0; r < stretch.size(); ++r) {
        EXPECT_NEAR(got.energies[r], expected.energies[r],
                    tolerance() * energy_scale(turned, r, stretch[r].norm()))
            << sample.name << " row " << r << " mu " << mu;
      }
    }
  }
}

TEST_P(FitRotations, RepeatBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 7));
  const TurnedRings turned = test::turned_rings(sample, 100, 0.3, 0.1, 8);
  const Fitted first = fit(*kernels, turned);
  const Fitted second = fit(*kernels, turned);
  EXPECT_EQ(first.transforms, second.transforms);
  EXPECT_EQ(first.energies, second.energies);
}

LAPWING_ON_ALL_TWINS(FitRotations);

TEST(FitRotationsInRanges, GiveTheSameBits) {
  LAPWING_NEEDS_GPU();
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 9));
  const TurnedRings turned = test::turned_rings(sample, 100, 0.3, 0.1, 10);
  const auto state = std::make_shared<VulkanState>(
      compile_kernels(std::make_shared<gpu::Context>(), Precision::float32), false);
  const auto run = [&](std::size_t most_entries) {
    VulkanRingRotations rotations(state, turned.rings, most_entries);
    const Fitted fitted = fit(rotations, turned);
    return std::pair(fitted.energies, fitted.gradient);
  };
  EXPECT_EQ(run(0), run(500));
  EXPECT_EQ(run(0), run(1));
}

}  // namespace
}  // namespace lapwing
