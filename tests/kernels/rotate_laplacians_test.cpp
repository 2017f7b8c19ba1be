#include <gtest/gtest.h>

#include "kernels/turned_rings.h"
#include "kernels/twins.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::Sample;
using test::TurnedRings;

class RotateLaplacians : public test::KernelTest {
 protected:
  struct Result {
    std::vector<Matrix3d> transforms;
    std::vector<double> b;
  };
  static Result rotate(Kernels& on, const TurnedRings& turned, RingMotion motion) {
    const auto rotations = on.make_ring_rotations(turned.rings, motion);
    std::vector<double> energies(turned.rings.row_count());
    rotations->fit_rotations(turned.displacement, energies);
    Result result{rotations->transforms(),
                  std::vector<double>(3 * turned.rings.unknown_rows.size())};
    rotations->rotate_laplacians(result.b);
    return result;
  }
};

// As the formula reads, row by row in place of unknown by unknown: what each row's transform adds
// is scattered to the vertices of its ring.
std::vector<double> scattered(const TurnedRings& turned, const std::vector<Matrix3d>& T) {
  const RegionRings& rings = turned.rings;
  std::vector<Vector3d> sum(rings.vertices.size(), Vector3d::Zero());
  for (std::size_t r = 0; r < rings.row_count(); ++r) {
    const Matrix3d change = T[r] - Matrix3d::Identity();
    const Vector3d row = change * turned.rest_laplacian(r);
    sum[r] += row;
    for (std::size_t e = rings.starts[r]; e < rings.starts[r + 1]; ++e) {
      const Index j = rings.neighbours[e];
      sum[j] -= rings.weights[e] * row;
      if (rings.stiffness.empty()) continue;
      const Vector3d held = rings.stiffness[e] * (change * -rings.edges[e]);
      sum[r] += held;
      sum[j] -= held;
    }
  }
  const std::size_t n = rings.unknown_rows.size();
  std::vector<double> b(3 * n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      b[axis * n + k] = sum[rings.unknown_rows[k]][static_cast<Eigen::Index>(axis)];
    }
  }
  return b;
}

TEST_P(RotateLaplacians, GatherWhatEveryRowScatters) {
  for (const Sample& sample : test::awkward_meshes()) {
    for (const double mu : {0.0, 0.7}) {
      for (const auto motion : {RingMotion::rotation, RingMotion::similarity}) {
        const TurnedRings turned = test::turned_rings(sample, 100, 0.2, mu, 11);
        const Result result = rotate(*kernels, turned, motion);
        const std::vector<double> expected = scattered(turned, result.transforms);
        double size = 1e-300;
        for (const Vector3d& edge : turned.rings.edges) size = std::max(size, edge.norm());
        for (std::size_t k = 0; k < expected.size(); ++k) {
          EXPECT_NEAR(result.b[k], expected[k], 40.0 * GetParam().tolerance * size)
              << sample.name << " mu " << mu;
        }
      }
    }
  }
}

TEST_P(RotateLaplacians, AskNothingOfASurfaceAtRest) {
  for (const Sample& sample : test::awkward_meshes()) {
    TurnedRings turned = test::turned_rings(sample, 0, 0.0, 0.5, 12);
    for (Vector3d& u : turned.displacement) u.setZero();
    double size = 0.0;
    for (const Vector3d& edge : turned.rings.edges) size = std::max(size, edge.norm());
    for (const double b : rotate(*kernels, turned, RingMotion::rotation).b) {
      EXPECT_LE(std::abs(b), 10.0 * GetParam().tolerance * size) << sample.name;
    }
  }
}

TEST_P(RotateLaplacians, RepeatBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 13));
  const TurnedRings turned = test::turned_rings(sample, 100, 0.3, 0.1, 14);
  EXPECT_EQ(rotate(*kernels, turned, RingMotion::rotation).b,
            rotate(*kernels, turned, RingMotion::rotation).b);
}

LAPWING_ON_ALL_TWINS(RotateLaplacians);

}  // namespace
}  // namespace lapwing
