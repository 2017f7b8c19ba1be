#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include "kernels/awkward_meshes.h"
#include "kernels/twins.h"
#include "lapwing/laplacian/energy_weights.h"
#include "lapwing/laplacian/laplacian_system.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test::Sample;

struct Weighted {
  explicit Weighted(const Sample& of)
      : sample(of),
        weights(energy_weights(of.topology, of.mesh.positions, of.vertices,
                               {LaplacianWeights::cotangent, 0.1})) {}
  EnergyProblem problem() const {
    return {{sample.mesh.positions, sample.topology.rings, weights.laplacian, sample.vertices},
            weights.rows,
            weights.stiffness};
  }
  const Sample& sample;
  EnergyWeights weights;
};

class AssembleTangent : public test::KernelTest {
 protected:
  static std::vector<double> assemble(Kernels& on, const EnergyProblem& problem) {
    std::vector<double> blocks(9 * rsi_block_starts(problem.rings).back());
    on.assemble_tangent(problem, blocks);
    return blocks;
  }
};

// Compares G'G row by row, because G itself depends on the choice of the factor F.
TEST_P(AssembleTangent, AgreesWithTheCpuTwin) {
  CpuKernels cpu;
  for (const Sample& sample : test::awkward_meshes()) {
    if (sample.vertices.empty()) continue;
    const Weighted weighted(sample);
    const EnergyProblem problem = weighted.problem();
    const auto starts = rsi_block_starts(problem.rings);
    const auto expected = assemble(cpu, problem);
    const auto got = assemble(*kernels, problem);
    for (std::size_t r = 0; r + 1 < starts.size(); ++r) {
      const auto columns = static_cast<Eigen::Index>(3 * (starts[r + 1] - starts[r]));
      const Eigen::Map<const MatrixXd> a(expected.data() + 9 * starts[r], 3, columns);
      const Eigen::Map<const MatrixXd> b(got.data() + 9 * starts[r], 3, columns);
      const MatrixXd square = a.transpose() * a;
      EXPECT_TRUE(b.allFinite()) << sample.name << " row " << r;
      EXPECT_LE((b.transpose() * b - square).norm(), 300.0 * GetParam().tolerance * square.norm())
          << sample.name << " row " << r;
    }
  }
}

// |G_i u|^2 = a_i' K_i^-1 a_i, where the pseudo-inverse replaces K_i^-1 for collinear one-rings.
TEST_P(AssembleTangent, RowsTakeAwayWhatTurningTheRingSaves) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const Sample& sample : test::awkward_meshes()) {
    if (sample.vertices.empty()) continue;
    const Weighted weighted(sample);
    const EnergyProblem problem = weighted.problem();
    const auto starts = rsi_block_starts(problem.rings);
    const auto blocks = assemble(*kernels, problem);
    const Adjacency& rings = sample.topology.rings;
    const Positions& v = sample.mesh.positions;
    std::vector<Vector3d> u(v.size());
    for (Vector3d& vector : u) vector = Vector3d::NullaryExpr([&] { return uniform(generator); });
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto ring = rings[static_cast<Index>(i)];
      const double om = problem.row_weights[i];
      const double* w = problem.rings.weights.data() + rings.starts[i];
      const double* k = problem.stiffness.data() + rings.starts[i];
      const Eigen::Map<const Matrix3d> own(blocks.data() + 9 * starts[i]);
      Vector3d row = own * u[i];
      Vector3d delta = Vector3d::Zero();
      Vector3d moved = Vector3d::Zero();
      for (std::size_t n = 0; n < ring.size(); ++n) {
        delta += w[n] * (v[i] - v[ring[n]]);
        moved += w[n] * (u[i] - u[ring[n]]);
      }
      Matrix3d C = om * delta * delta.transpose();
      Vector3d a = om * delta.cross(moved);
      double held = om * moved.squaredNorm();  // the energy at fixed rotations
      for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vector3d e = v[i] - v[ring[n]];
        const Vector3d difference = u[i] - u[ring[n]];
        C += k[n] * e * e.transpose();
        a += k[n] * e.cross(difference);
        held += k[n] * difference.squaredNorm();
        row += Eigen::Map<const Matrix3d>(own.data() + 9 * (n + 1)) * u[ring[n]];
      }
      Eigen::CompleteOrthogonalDecomposition<Matrix3d> K;
      K.setThreshold(1e-9);
      K.compute(C.trace() * Matrix3d::Identity() - C);
      const double saved = C.trace() > 0.0 ? a.dot(K.solve(a)) : 0.0;
      EXPECT_LE(saved, held * (1.0 + 1e-12)) << sample.name << " row " << i;
      EXPECT_NEAR(row.squaredNorm(), saved, 300.0 * GetParam().tolerance * held)
          << sample.name << " row " << i;
    }
  }
}

TEST_P(AssembleTangent, RepeatsBitForBit) {
  const Sample sample("rough sphere", test::rough_sphere(3, 0.2, 13));
  const Weighted weighted(sample);
  EXPECT_EQ(assemble(*kernels, weighted.problem()), assemble(*kernels, weighted.problem()));
}

LAPWING_ON_ALL_TWINS(AssembleTangent);

// Assembles the tangent of a whole sphere as a dense matrix.
class TangentOfASphere : public ::testing::Test {
 protected:
  TangentOfASphere() {
    const Unknowns unknowns(sample_.vertices, sample_.vertices.size());
    const SystemPattern pattern(sample_.topology, sample_.vertices, unknowns);
    LaplacianSystem laplacian(sample_.topology, sample_.vertices, unknowns, pattern);
    laplacian.assemble(sample_.mesh.positions, {LaplacianWeights::cotangent, 0.1});
    laplacian.analyze();
    rings_ = laplacian.rings();
    const Weighted weighted(sample_);
    BlockRows G = rsi_rows(sample_.topology.rings, sample_.vertices);
    CpuKernels kernels;
    kernels.assemble_tangent(weighted.problem(), G.values);
    const BlockMatrix H = pattern.normal().reduced_matrix(laplacian.unconstrained_matrix(), G);
    const auto n = static_cast<Eigen::Index>(3 * sample_.vertices.size());
    dense_ = MatrixXd::Zero(n, n);
    for (std::size_t c = 0; c < H.pattern->size(); ++c) {
      for (std::size_t e = H.pattern->starts[c]; e < H.pattern->starts[c + 1]; ++e) {
        const auto r = static_cast<Eigen::Index>(3 * H.pattern->rows[e]);
        const auto column = static_cast<Eigen::Index>(3 * c);
        const Eigen::Map<const Eigen::Matrix3d> block(H.block(e).data());
        dense_.block<3, 3>(r, column) = block;
        dense_.block<3, 3>(column, r) = block.transpose();
      }
    }
  }

  Sample sample_{"rough sphere", test::rough_sphere(2, 0.1, 21)};
  RegionRings rings_;
  MatrixXd dense_;
};

TEST_F(TangentOfASphere, IsPositiveSemidefiniteAndKnowsRigidMotionsAlone) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(dense_, Eigen::EigenvaluesOnly);
  const VectorXd values = eigen.eigenvalues();
  const double largest = values[values.size() - 1];
  EXPECT_GE(values[0], -1e-13 * largest);
  EXPECT_LE(values[5], 1e-13 * largest);
  EXPECT_GE(values[6], 1e-9 * largest);
  for (int k = 0; k < 6; ++k) {
    VectorXd u(dense_.rows());
    for (std::size_t v = 0; v < sample_.mesh.vertex_count(); ++v) {
      const Vector3d axis = Vector3d::Unit(k % 3);
      u.segment<3>(static_cast<Eigen::Index>(3 * v)) =
          k < 3 ? axis : Vector3d(axis.cross(sample_.mesh.positions[v]));
    }
    EXPECT_LE((dense_ * u).norm(), 1e-12 * largest * u.norm());
  }
}

// For a small displacement, the quadratic form of the tangent equals the energy at optimal
// rotations.
TEST_F(TangentOfASphere, IsTheEnergyToSecondOrder) {
  CpuKernels kernels;
  const auto rotations = kernels.make_ring_rotations(std::make_shared<RegionRings>(rings_));
  std::vector<double> energies(rings_.row_count());
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  VectorXd u(dense_.rows());
  for (double& number : u) number = uniform(generator);
  const double expected = u.dot(dense_ * u);
  for (const double size : {1e-3, 1e-4}) {
    std::vector<Vector3d> displacement;
    for (const Index v : rings_.vertices) {
      displacement.emplace_back(size * u.segment<3>(static_cast<Eigen::Index>(3 * v)));
    }
    rotations->fit_rotations(displacement, energies);
    double energy = 0.0;
    for (const double e : energies) energy += e;
    EXPECT_NEAR(energy / (size * size), expected, 20.0 * size * expected);
  }
}

}  // namespace
}  // namespace lapwing
