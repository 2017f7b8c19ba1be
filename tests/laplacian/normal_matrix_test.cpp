#include "lapwing/laplacian/normal_matrix.h"

#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <gtest/gtest.h>

#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/mesh/shapes.h"

namespace lapwing {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

struct System {
  Mesh mesh;
  Topology topology;
  std::vector<Index> rows;
  BlockRows M;
  Unknowns unknowns;

  System(Mesh m, std::vector<Index> row_list, std::vector<Index> unknown_list)
      : mesh(std::move(m)), topology(mesh.topology()), rows(std::move(row_list)) {
    const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);
    CpuKernels kernels;
    M = assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, rows});
    unknowns = Unknowns(std::move(unknown_list), mesh.vertex_count());
  }

  Sparse sparse() const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t r = 0; r < M.size(); ++r) {
      for (std::size_t b = M.starts[r]; b < M.starts[r + 1]; ++b) {
        const Index u = unknowns.of_vertex[M.columns[b]];
        if (u == kNoIndex) continue;
        for (std::size_t k = 0; k < 9; ++k) {
          entries.emplace_back(static_cast<int>(3 * r + k % 3), static_cast<int>(3 * u + k / 3),
                               M.values[9 * b + k]);
        }
      }
    }
    Sparse S(static_cast<int>(3 * M.size()), static_cast<int>(3 * unknowns.size()));
    S.setFromTriplets(entries.begin(), entries.end());
    return S;
  }
};

System half_of_a_torus() {
  Mesh mesh = torus(14, 9, 2.0, 0.6);
  std::vector<Index> rows;
  std::vector<Index> unknowns;
  for (Index v = 0; v < mesh.vertex_count() / 2; ++v) {
    rows.push_back(v);
    if (v % 5 != 0) unknowns.push_back(v);
  }
  return {std::move(mesh), rows, unknowns};
}

Eigen::MatrixXd dense(const BlockMatrix& N) {
  const auto n = static_cast<Eigen::Index>(N.scalar_size());
  const Eigen::Index size = N.block_size;
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t c = 0; c < N.pattern->size(); ++c) {
    for (std::size_t e = N.pattern->starts[c]; e < N.pattern->starts[c + 1]; ++e) {
      const auto r = static_cast<Eigen::Index>(N.pattern->rows[e]);
      const auto column = static_cast<Eigen::Index>(c);
      const Eigen::Map<const Eigen::MatrixXd> block(N.block(e).data(), size, size);
      D.block(size * r, size * column, size, size) = block;
      D.block(size * column, size * r, size, size) = block.transpose();
    }
  }
  return D;
}

TEST(NormalMatrix, EqualsTheSparseProduct) {
  const System system = half_of_a_torus();
  const NormalPattern pattern(system.M, system.unknowns);
  std::vector<double> W(system.unknowns.size());
  std::iota(W.begin(), W.end(), 0.5);
  const BlockMatrix N = pattern.normal_matrix(system.M, W);
  const Sparse S = system.sparse();
  Eigen::MatrixXd expected = Eigen::MatrixXd(S.transpose() * S);
  for (std::size_t u = 0; u < W.size(); ++u) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i = static_cast<Eigen::Index>(3 * u + k);
      expected(i, i) += W[u];
    }
  }
  EXPECT_LT((dense(N) - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(NormalMatrix, IsTheSameInMemoryThatHeldAnother) {
  const System system = half_of_a_torus();
  const NormalPattern pattern(system.M, system.unknowns);
  const BlockMatrix expected = pattern.normal_matrix(system.M);
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, 2 * expected.values.size()}) {
    const BlockMatrix N = pattern.normal_matrix(system.M, {}, Numbers(size, 7.0));
    EXPECT_EQ(N.values, expected.values) << size;
  }
}

TEST(NormalMatrix, ReducedMatrixIsTheScalarOneForEachAxisLessTheSparseProduct) {
  const System system = half_of_a_torus();
  const NormalPattern pattern(system.M, system.unknowns);
  const auto weights =
      laplacian_weights(system.topology, system.mesh.positions, LaplacianWeights::cotangent);
  const BlockRows L = laplacian_rows(system.topology.rings, weights, system.rows);
  const BlockMatrix A = pattern.normal_matrix(L);
  const Sparse S = system.sparse();
  Eigen::MatrixXd expected = -Eigen::MatrixXd(S.transpose() * S);
  const Eigen::MatrixXd scalar = dense(A);
  for (Eigen::Index c = 0; c < scalar.cols(); ++c) {
    for (Eigen::Index r = 0; r < scalar.rows(); ++r) {
      expected.block<3, 3>(3 * r, 3 * c).diagonal().array() += scalar(r, c);
    }
  }
  const BlockMatrix N = pattern.reduced_matrix(A, system.M);
  EXPECT_LT((dense(N) - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
  EXPECT_EQ(pattern.reduced_matrix(A, system.M, Numbers(2 * N.values.size(), 7.0)).values,
            N.values);
}

TEST(NormalMatrix, ProductsWithMAndItsTransposeMatchTheSparseOnes) {
  const System system = half_of_a_torus();
  const NormalPattern pattern(system.M, system.unknowns);
  const Sparse S = system.sparse();
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  std::vector<Eigen::Vector3d> displacement(system.mesh.vertex_count(), Eigen::Vector3d::Zero());
  Eigen::VectorXd x(S.cols());
  for (std::size_t u = 0; u < system.unknowns.size(); ++u) {
    Eigen::Vector3d& d = displacement[system.unknowns.vertices[u]];
    for (int k = 0; k < 3; ++k) d(k) = normal(generator);
    x.segment<3>(static_cast<Eigen::Index>(3 * u)) = d;
  }
  std::vector<double> r(3 * system.M.size());
  multiply(system.M, displacement, r);
  const Eigen::Map<const Eigen::VectorXd> r_map(r.data(), static_cast<Eigen::Index>(r.size()));
  EXPECT_LT((r_map - S * x).norm(), 1e-13 * x.norm());
  std::vector<double> y(3 * system.unknowns.size());
  pattern.multiply_transposed(system.M, r, y);
  const Eigen::Map<const Eigen::VectorXd> y_map(y.data(), static_cast<Eigen::Index>(y.size()));
  EXPECT_LT((y_map - S.transpose() * r_map).norm(), 1e-13 * x.norm());
}

TEST(NormalMatrix, SimilaritiesOfTheWholeMeshAreItsNullSpace) {
  Mesh mesh = icosphere(2);
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  const System system(std::move(mesh), all, all);
  const Eigen::Vector3d h(0.3, -1.0, 0.5);
  std::vector<Eigen::Vector3d> motion;
  for (const Eigen::Vector3d& p : system.mesh.positions) {
    motion.push_back(Eigen::Vector3d(1, 2, 3) + 0.7 * p + h.cross(p));
  }
  std::vector<double> r(3 * system.M.size());
  multiply(system.M, motion, r);
  EXPECT_LT(Eigen::Map<Eigen::VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()))
                .cwiseAbs()
                .maxCoeff(),
            1e-14);
}

}  // namespace
}  // namespace lapwing
