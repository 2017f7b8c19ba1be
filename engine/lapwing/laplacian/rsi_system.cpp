#include "lapwing/laplacian/rsi_system.h"

#include "lapwing/base/parallel.h"

namespace lapwing {

BlockRows ring_blocks(const Adjacency& rings, std::span<const Index> rows) {
  BlockRows blocks;
  blocks.starts.reserve(rows.size() + 1);
  for (const Index i : rows) blocks.starts.push_back(blocks.starts.back() + 1 + rings.size(i));
  blocks.columns.reserve(blocks.starts.back());
  for (const Index i : rows) {
    const auto ring = rings[i];
    blocks.columns.push_back(i);
    blocks.columns.insert(blocks.columns.end(), ring.begin(), ring.end());
  }
  return blocks;
}

BlockRows rsi_rows(const Adjacency& rings, std::span<const Index> rows) {
  BlockRows M = ring_blocks(rings, rows);
  M.values.resize(9 * M.columns.size());
  return M;
}

BlockRows laplacian_rows(const Adjacency& rings, std::span<const double> weights,
                         std::span<const Index> rows) {
  BlockRows L = ring_blocks(rings, rows);
  L.block_size = 1;
  L.values.reserve(L.columns.size());
  for (const Index i : rows) {
    L.values.push_back(rings.size(i) == 0 ? 0.0 : 1.0);
    for (std::size_t e = rings.starts[i]; e < rings.starts[i + 1]; ++e) {
      L.values.push_back(-weights[e]);
    }
  }
  return L;
}

Unknowns::Unknowns(std::vector<Index> list, std::size_t vertex_count)
    : vertices(std::move(list)), of_vertex(inverse_index(vertices, vertex_count)) {}

void multiply(const BlockRows& M, std::span<const Eigen::Vector3d> displacement,
              std::span<double> r) {
  constexpr std::size_t kRowsPerTask = 2048;
  parallel_for(M.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t b = M.starts[row]; b < M.starts[row + 1]; ++b) {
        if (M.block_size == 1) {
          sum += M.values[b] * displacement[M.columns[b]];
        } else {
          sum += Eigen::Map<const Eigen::Matrix3d>(M.values.data() + 9 * b) *
                 displacement[M.columns[b]];
        }
      }
      Eigen::Map<Eigen::Vector3d>(r.data() + 3 * row) = sum;
    }
  });
}

void NormalPattern::multiply_transposed(const BlockRows& M, std::span<const double> r,
                                        std::span<double> y) const {
  constexpr std::size_t kRowsPerTask = 2048;
  parallel_for(blocks_.size(), kRowsPerTask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t u = begin; u < end; ++u) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const Entry& e : entries(u)) {
        const Eigen::Map<const Eigen::Vector3d> r_row(r.data() + std::size_t{3} * e.row);
        if (M.block_size == 1) {
          sum += M.values[e.block] * r_row;
        } else {
          sum +=
              Eigen::Map<const Eigen::Matrix3d>(M.values.data() + 9 * e.block).transpose() * r_row;
        }
      }
      Eigen::Map<Eigen::Vector3d>(y.data() + 3 * u) = sum;
    }
  });
}

}  // namespace lapwing
