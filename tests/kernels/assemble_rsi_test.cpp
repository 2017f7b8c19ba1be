#include <algorithm>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/twins.h"
#include "lapwing/laplacian/ring_fit.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using test::Sample;

class AssembleRsi : public test::KernelTest {
 protected:
  std::vector<double> assemble(Kernels& on, const RingProblem& problem) const {
    std::vector<double> blocks(9 * rsi_block_starts(problem).back());
    on.assemble_rsi(problem, blocks);
    return blocks;
  }
};

// Returns the largest absolute entry of a row's blocks, but at least 1, the diagonal entry of the
// Laplacian.
double row_size(std::span<const double> row) {
  double size = 1.0;
  for (const double entry : row) size = std::max(size, std::abs(entry));
  return size;
}

// Returns the largest difference of two results, relative to the largest entry of each row.
double relative_difference(const RingProblem& problem, std::span<const double> a,
                           std::span<const double> b) {
  const auto starts = rsi_block_starts(problem);
  double worst = 0.0;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
    const double size = row_size(b.subspan(9 * starts[r], 9 * (starts[r + 1] - starts[r])));
    for (std::size_t e = 9 * starts[r]; e < 9 * starts[r + 1]; ++e) {
      const double difference = std::abs(a[e] - b[e]) / size;
      worst = std::isfinite(difference) ? std::max(worst, difference) : 1.0;
    }
  }
  return worst;
}

// Returns the row of vertex i by eq. 10, using the pseudo-inverse of A for the seven unknowns of
// the transformation.
MatrixXd row_by_pseudo_inverse(const Sample& sample, Index i) {
  const auto ring = sample.topology.rings[i];
  const auto& v = sample.mesh.positions;
  std::vector<Index> K{i};
  K.insert(K.end(), ring.begin(), ring.end());
  const auto rows = static_cast<Eigen::Index>(3 * K.size());
  MatrixXd A(rows, 7);
  MatrixXd row(3, rows);
  Vector3d delta = Vector3d::Zero();
  for (std::size_t k = 0; k < K.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(3 * k);
    A.block<3, 1>(at, 0) = v[K[k]];
    A.block<3, 3>(at, 1) = -cross_matrix(v[K[k]]);
    A.block<3, 3>(at, 4) = Matrix3d::Identity();
    const double l = k == 0 ? 1.0 : -1.0 / static_cast<double>(ring.size());
    row.block<3, 3>(0, at) = -l * Matrix3d::Identity();
    delta += l * v[K[k]];
  }
  MatrixXd apply_to_delta(3, 4);
  apply_to_delta << delta, -cross_matrix(delta);
  const MatrixXd inverse = A.completeOrthogonalDecomposition().pseudoInverse();
  return row + apply_to_delta * inverse.topRows(4);
}

TEST(AssembleRsiOnTheCpu, IsThePseudoInverseOfEquationTen) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Sample sample("rough sphere", test::rough_sphere(1, 0.15, seed));
    const RingProblem problem = sample.problem();
    const auto starts = rsi_block_starts(problem);
    std::vector<double> blocks(9 * starts.back());
    CpuKernels().assemble_rsi(problem, blocks);
    for (Index i = 0; i < sample.vertices.size(); ++i) {
      const MatrixXd expected = row_by_pseudo_inverse(sample, i);
      const Eigen::Map<const MatrixXd> row(blocks.data() + 9 * starts[i], 3, expected.cols());
      EXPECT_LT((row - expected).cwiseAbs().maxCoeff(), 1e-12) << "seed " << seed << " row " << i;
    }
  }
}

TEST_P(AssembleRsi, AgreesWithTheCpuTwin) {
  CpuKernels cpu;
  for (const Sample& sample : test::awkward_meshes()) {
    const RingProblem problem = sample.problem();
    const auto expected = assemble(cpu, problem);
    EXPECT_LE(relative_difference(problem, assemble(*kernels, problem), expected),
              GetParam().tolerance)
        << sample.name;
  }
}

TEST_P(AssembleRsi, VanishesOnTranslationScaleAndLinearizedRotation) {
  const Vector3d h(0.3, -0.5, 0.8);
  for (const Sample& sample : test::awkward_meshes()) {
    const RingProblem problem = sample.problem();
    const auto starts = rsi_block_starts(problem);
    const auto blocks = assemble(*kernels, problem);
    const double size = std::max(bounds_of(sample.mesh.positions).diagonal(), 1e-300);
    for (std::size_t r = 0; r < sample.vertices.size(); ++r) {
      const Vector3d center = sample.mesh.positions[r];
      Vector3d translation = Vector3d::Zero();
      Vector3d scale = Vector3d::Zero();
      Vector3d rotation = Vector3d::Zero();
      double weight = 1.0;
      for (std::size_t b = starts[r]; b < starts[r + 1]; ++b) {
        const Eigen::Map<const Matrix3d> B(blocks.data() + 9 * b);
        const std::size_t k = b - starts[r];
        const Vector3d v = k == 0 ? center : sample.mesh.positions[sample.topology.rings[r][k - 1]];
        translation += B * Vector3d::Ones();
        scale += B * (v - center) / size;
        rotation += B * h.cross(v - center) / size;
        weight += B.norm();
      }
      const double tolerance = GetParam().tolerance * weight;
      const bool loose = starts[r + 1] == starts[r] + 1;
      EXPECT_LE(translation.norm(), loose ? 0.0 : tolerance) << sample.name << " row " << r;
      EXPECT_LE(scale.norm(), tolerance) << sample.name << " row " << r;
      EXPECT_LE(rotation.norm(), tolerance) << sample.name << " row " << r;
    }
  }
}

TEST_P(AssembleRsi, RowsComeInTheOrderAskedFor) {
  const Sample sample("rough sphere", test::rough_sphere(2, 0.2, 5));
  std::vector<Index> some{7, 3, 100, 0, 55};
  RingProblem problem = sample.problem();
  const auto all_starts = rsi_block_starts(problem);
  const auto all = assemble(*kernels, problem);
  problem.rows = some;
  const auto starts = rsi_block_starts(problem);
  const auto blocks = assemble(*kernels, problem);
  for (std::size_t r = 0; r < some.size(); ++r) {
    EXPECT_TRUE(std::equal(blocks.begin() + static_cast<std::ptrdiff_t>(9 * starts[r]),
                           blocks.begin() + static_cast<std::ptrdiff_t>(9 * starts[r + 1]),
                           all.begin() + static_cast<std::ptrdiff_t>(9 * all_starts[some[r]])));
  }
}

// The mesh has more rows than one submission to a device can process.
TEST_P(AssembleRsi, ManyRowsAgreeWithTheCpuTwin) {
  const Sample sample("sphere", test::rough_sphere(6, 0.005, 6));
  const RingProblem problem = sample.problem();
  CpuKernels cpu;
  EXPECT_LE(relative_difference(problem, assemble(*kernels, problem), assemble(cpu, problem)),
            GetParam().tolerance);
}

TEST_P(AssembleRsi, RepeatsBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 7));
  const auto first = assemble(*kernels, sample.problem());
  EXPECT_EQ(assemble(*kernels, sample.problem()), first);
}

LAPWING_ON_ALL_TWINS(AssembleRsi);

}  // namespace
}  // namespace lapwing
