#include <algorithm>

#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/twins.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Vector3d;
using test::Sample;

class SampleLaplacians : public test::KernelTest {
 protected:
  static Positions sample_on(Kernels& on, const RingProblem& problem) {
    Positions laplacians(problem.rows.size());
    on.sample_laplacians(problem, laplacians);
    return laplacians;
  }
};

TEST_P(SampleLaplacians, AgreeWithTheCpuTwin) {
  CpuKernels cpu;
  for (const Sample& sample : test::awkward_meshes()) {
    for (const auto scheme : {LaplacianWeights::uniform, LaplacianWeights::cotangent}) {
      const auto weights = laplacian_weights(sample.topology, sample.mesh.positions, scheme);
      RingProblem problem = sample.problem();
      problem.weights = weights;
      const Positions expected = sample_on(cpu, problem);
      const Positions laplacians = sample_on(*kernels, problem);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        double edges = 0.0;
        for (const Index j : problem.rings[i]) {
          edges = std::max(edges, (sample.mesh.positions[i] - sample.mesh.positions[j]).norm());
        }
        EXPECT_LE((laplacians[i] - expected[i]).norm(), GetParam().tolerance * edges)
            << sample.name << " vertex " << i;
      }
    }
  }
}

TEST_P(SampleLaplacians, PointAlongTheNormalOfASphere) {
  const Sample sample("sphere", icosphere(2));
  const Positions laplacians = sample_on(*kernels, sample.problem());
  for (std::size_t i = 0; i < laplacians.size(); ++i) {
    EXPECT_GT(laplacians[i].normalized().dot(sample.mesh.positions[i]), 0.98);
  }
}

TEST_P(SampleLaplacians, DoNotSeeWhereTheMeshLies) {
  Mesh mesh = test::rough_sphere(2, 0.2, 8);
  // Round positions to multiples of 2^-20, so that adding the offset is exact.
  constexpr double kGrid = 1 << 20;
  for (Vector3d& p : mesh.positions) p = (p * kGrid).array().round().matrix() / kGrid;
  const Sample here("here", mesh);
  for (Vector3d& p : mesh.positions) p += Vector3d(1e4, -1e4, 1e4);
  const Sample there("there", mesh);
  const Positions a = sample_on(*kernels, here.problem());
  const Positions b = sample_on(*kernels, there.problem());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LE((a[i] - b[i]).norm(), GetParam().tolerance) << "vertex " << i;
  }
}

TEST_P(SampleLaplacians, RepeatBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 9));
  const Positions first = sample_on(*kernels, sample.problem());
  EXPECT_EQ(sample_on(*kernels, sample.problem()), first);
}

LAPWING_ON_ALL_TWINS(SampleLaplacians);

}  // namespace
}  // namespace lapwing
