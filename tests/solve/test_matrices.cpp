#include "solve/test_matrices.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "lapwing/kernels/cpu_kernels.h"
#include "lapwing/laplacian/normal_matrix.h"
#include "lapwing/laplacian/weights.h"
#include "lapwing/solve/ordering.h"

namespace lapwing::test {

MatrixBuilder::MatrixBuilder(std::size_t blocks, int block_size)
    : block_size_(static_cast<std::size_t>(block_size)), columns_(blocks) {
  for (std::size_t c = 0; c < blocks; ++c) {
    columns_[c][static_cast<Index>(c)].resize(block_size_ * block_size_);
  }
}

void MatrixBuilder::add(std::size_t row, std::size_t column, double value) {
  const std::size_t b = block_size_;
  if (row / b < column / b) return;
  auto& block = columns_[column / b][static_cast<Index>(row / b)];
  block.resize(b * b);
  block[(column % b) * b + row % b] += value;
}

OwnedMatrix MatrixBuilder::build() const {
  OwnedMatrix owned;
  owned.pattern = std::make_unique<BlockPattern>();
  owned.matrix.pattern = owned.pattern.get();
  owned.matrix.block_size = static_cast<int>(block_size_);
  for (const auto& column : columns_) {
    for (const auto& [row, block] : column) {
      owned.pattern->rows.push_back(row);
      owned.matrix.values.insert(owned.matrix.values.end(), block.begin(), block.end());
    }
    owned.pattern->starts.push_back(owned.pattern->rows.size());
  }
  return owned;
}

OwnedMatrix random_matrix(std::size_t blocks, int block_size, double degree, double margin,
                          unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const auto b = static_cast<std::size_t>(block_size);
  const std::size_t n = blocks * b;
  MatrixBuilder builder(blocks, block_size);
  std::vector<double> row_sums(n, 0.0);
  const auto add = [&](std::size_t row, std::size_t column) {
    const double value = number(random);
    builder.add(row, column, value);
    builder.add(column, row, value);
    row_sums[row] += std::abs(value);
    row_sums[column] += std::abs(value);
  };
  for (std::size_t c = 0; c < blocks; ++c) {
    for (std::size_t p = 0; p < b; ++p) {
      for (std::size_t q = 0; q < p; ++q) add(c * b + p, c * b + q);
    }
  }
  for (std::size_t e = 0;
       blocks > 1 && e < static_cast<std::size_t>(degree * static_cast<double>(blocks) / 2); ++e) {
    const std::size_t row = random() % blocks;
    const std::size_t column = random() % blocks;
    if (row == column) continue;
    for (std::size_t p = 0; p < b; ++p) {
      for (std::size_t q = 0; q < b; ++q) add(row * b + p, column * b + q);
    }
  }
  for (std::size_t i = 0; i < n; ++i) builder.add(i, i, row_sums[i] * (1.0 + margin) + margin);
  return builder.build();
}

OwnedMatrix dense_matrix(std::size_t blocks, int block_size, unsigned seed) {
  const std::size_t n = blocks * static_cast<std::size_t>(block_size);
  const std::vector<double> X = random_vector(n * n, seed);
  MatrixBuilder builder(blocks, block_size);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      builder.add(i, j, std::inner_product(&X[i * n], &X[i * n] + n, &X[j * n], 0.0));
    }
  }
  return builder.build();
}

OwnedMatrix laplacian_matrix(const Mesh& mesh, double weight, std::size_t step) {
  const Topology& topology = mesh.topology();
  MatrixBuilder builder(mesh.vertex_count(), 1);
  std::vector<std::pair<Index, double>> row;
  for (Index i = 0; i < topology.vertex_count(); ++i) {
    if (step > 0 && i % step == 0) builder.add(i, i, weight);
    const auto ring = topology.rings[i];
    if (ring.empty()) continue;
    row.assign(1, {i, 1.0});
    for (const Index j : ring) row.emplace_back(j, -1.0 / static_cast<double>(ring.size()));
    for (const auto& [j, a] : row) {
      for (const auto& [k, c] : row) builder.add(j, k, a * c);
    }
  }
  return builder.build();
}

OwnedMatrix rsi_matrix(const Mesh& mesh, double weight, std::size_t step) {
  std::vector<Index> all(mesh.vertex_count());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<double> W(all.size(), 0.0);
  for (std::size_t i = 0; step > 0 && i < W.size(); i += step) W[i] = weight;
  return rsi_matrix(mesh, all, W);
}

OwnedMatrix rsi_matrix(const Mesh& mesh, const std::vector<Index>& roi, std::span<const double> W) {
  const Topology& topology = mesh.topology();
  const auto weights = laplacian_weights(topology, mesh.positions, LaplacianWeights::uniform);
  CpuKernels kernels;
  const BlockRows M = assemble_rsi_rows(kernels, {mesh.positions, topology.rings, weights, roi});
  const NormalPattern pattern(M, Unknowns(roi, mesh.vertex_count()));
  OwnedMatrix owned;
  owned.matrix = pattern.normal_matrix(M, W);
  owned.pattern = std::make_unique<BlockPattern>(pattern.blocks());
  owned.matrix.pattern = owned.pattern.get();
  return owned;
}

void scale_badly(BlockMatrix& matrix, double decades, unsigned seed) {
  const auto b = static_cast<std::size_t>(matrix.block_size);
  std::vector<double> scale = random_vector(matrix.scalar_size(), seed);
  for (double& s : scale) s = std::pow(10.0, -decades * std::abs(s));
  for (std::size_t c = 0; c < matrix.pattern->size(); ++c) {
    for (std::size_t e = matrix.pattern->starts[c]; e < matrix.pattern->starts[c + 1]; ++e) {
      for (std::size_t k = 0; k < b * b; ++k) {
        matrix.values[e * b * b + k] *=
            scale[c * b + k / b] * scale[matrix.pattern->rows[e] * b + k % b];
      }
    }
  }
}

void add_to_diagonal(BlockMatrix& matrix, Index block, double value) {
  const auto b = static_cast<std::size_t>(matrix.block_size);
  double* values = matrix.values.data() + matrix.pattern->starts[block] * b * b;
  for (std::size_t k = 0; k < b; ++k) values[k * b + k] += value;
}

std::vector<double> random_vector(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> v(count);
  for (double& x : v) x = number(random);
  return v;
}

namespace {

double norm_of(const BlockMatrix& A) {
  BlockMatrix absolute = A;
  for (double& value : absolute.values) value = std::abs(value);
  const std::vector<double> ones(A.scalar_size(), 1.0);
  std::vector<double> sums(A.scalar_size());
  multiply(absolute, ones, sums, 1);
  return sums.empty() ? 0.0 : *std::max_element(sums.begin(), sums.end());
}

double norm_of(std::span<const double> v) {
  double norm = 0.0;
  for (const double x : v) norm = std::isnan(x) ? x : std::max(norm, std::abs(x));
  return norm;
}

}  // namespace

double backward_error(const BlockMatrix& A, std::span<const double> x, std::span<const double> b,
                      std::size_t columns) {
  const std::size_t n = A.scalar_size();
  std::vector<double> residual(n * columns);
  multiply(A, x, residual, columns);
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] -= b[i];
  const double norm = norm_of(A);
  double worst = 0.0;
  for (std::size_t k = 0; k < columns; ++k) {
    const double scale = norm * norm_of(x.subspan(k * n, n)) + norm_of(b.subspan(k * n, n));
    const double r = norm_of(std::span(residual).subspan(k * n, n));
    if (r != 0.0) worst = std::isnan(r / scale) ? r / scale : std::max(worst, r / scale);
  }
  return worst;
}

std::vector<double> solve_with(BlockSolver& solver, const BlockMatrix& A, std::span<const double> b,
                               std::size_t columns) {
  solver.analyze(*A.pattern, A.block_size,
                 fill_reducing_order(*A.pattern, Ordering::minimum_degree));
  solver.factorize(A);
  std::vector<double> x(b.size());
  solver.solve(b, x, columns);
  return x;
}

}  // namespace lapwing::test
