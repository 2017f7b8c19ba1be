#include "lapwing/laplacian/normal_matrix.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

constexpr std::size_t kColumnsPerTask = 1024;

// Computes out += kSign A' B for 3 x 3 blocks in column-major order.
template <int kSign>
void add_transposed_product(const double* A, const double* B, double* out) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      out[3 * c + r] +=
          kSign * (A[3 * r] * B[3 * c] + A[3 * r + 1] * B[3 * c + 1] + A[3 * r + 2] * B[3 * c + 2]);
    }
  }
}

}  // namespace

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

NormalPattern::NormalPattern(const BlockRows& M, const Unknowns& unknowns) {
  find_entries(M, unknowns);
  blocks_.starts.assign(unknowns.size() + 1, 0);
  find_blocks(M);
}

void NormalPattern::find_entries(const BlockRows& M, const Unknowns& unknowns) {
  unknown_of_block_.resize(M.columns.size());
  entry_starts_.assign(unknowns.size() + 1, 0);
  for (std::size_t b = 0; b < M.columns.size(); ++b) {
    const Index u = unknown_of_block_[b] = unknowns.of_vertex[M.columns[b]];
    if (u != kNoIndex) ++entry_starts_[u + 1];
  }
  for (std::size_t u = 0; u < unknowns.size(); ++u) entry_starts_[u + 1] += entry_starts_[u];
  entries_.resize(entry_starts_.back());
  std::vector<std::size_t> next(entry_starts_.begin(), entry_starts_.end() - 1);
  CancelCheck cancel_check;
  for (std::size_t row = 0; row < M.size(); ++row) {
    cancel_check();
    for (std::size_t b = M.starts[row]; b < M.starts[row + 1]; ++b) {
      const Index u = unknown_of_block_[b];
      if (u != kNoIndex) entries_[next[u]++] = {static_cast<Index>(row), b};
    }
  }
}

// Column c of N contains a block for every unknown r >= c that shares a row of M with c.
void NormalPattern::find_blocks(const BlockRows& M) {
  const std::size_t n = blocks_.size();
  const std::size_t task_count = (n + kColumnsPerTask - 1) / kColumnsPerTask;
  std::vector<std::vector<Index>> found(task_count);
  parallel_for(task_count, 1, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> seen(n, kNoIndex);
    for (std::size_t task = begin; task < end; ++task) {
      check_cancelled();
      std::vector<Index>& rows = found[task];
      for (std::size_t c = task * kColumnsPerTask; c < std::min(n, (task + 1) * kColumnsPerTask);
           ++c) {
        const auto first = static_cast<std::ptrdiff_t>(rows.size());
        rows.push_back(static_cast<Index>(c));
        for (const Entry& e : entries(c)) {
          for (std::size_t b = M.starts[e.row]; b < M.starts[e.row + 1]; ++b) {
            const Index r = unknown_of_block_[b];
            if (r == kNoIndex || r <= c || seen[r] == c) continue;
            seen[r] = static_cast<Index>(c);
            rows.push_back(r);
          }
        }
        std::sort(rows.begin() + first, rows.end());
        blocks_.starts[c + 1] = rows.size() - static_cast<std::size_t>(first);
      }
    }
  });
  for (std::size_t c = 0; c < n; ++c) blocks_.starts[c + 1] += blocks_.starts[c];
  blocks_.rows.resize(blocks_.starts.back());
  parallel_for(task_count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t first = blocks_.starts[task * kColumnsPerTask];
      std::copy(found[task].begin(), found[task].end(),
                blocks_.rows.begin() + static_cast<std::ptrdiff_t>(first));
    }
  });
}

template <int kSign, typename Begin>
void NormalPattern::add_products(const BlockRows& M, BlockMatrix& N,
                                 const Begin& begin_column) const {
  const std::size_t n = blocks_.size();
  const auto size = static_cast<std::size_t>(M.block_size);
  const std::size_t numbers = size * size;
  parallel_for(n, kColumnsPerTask, [&](std::size_t begin, std::size_t end) {
    // For each row in the current column, its entry. All other elements are outdated and not read.
    std::vector<std::size_t> place(n);
    CancelCheck cancel_check;
    for (std::size_t c = begin; c < end; ++c) {
      cancel_check();
      for (std::size_t e = blocks_.starts[c]; e < blocks_.starts[c + 1]; ++e) {
        place[blocks_.rows[e]] = e;
      }
      begin_column(c);
      for (const Entry& entry : entries(c)) {
        const double* B_c = M.values.data() + numbers * entry.block;
        for (std::size_t b = M.starts[entry.row]; b < M.starts[entry.row + 1]; ++b) {
          const Index r = unknown_of_block_[b];
          if (r == kNoIndex || r < c) continue;
          const double* B_r = M.values.data() + numbers * b;
          double* out = N.values.data() + numbers * place[r];
          if (size == 1) {
            *out += kSign * *B_r * *B_c;
          } else {
            add_transposed_product<kSign>(B_r, B_c, out);
          }
        }
      }
    }
  });
}

BlockMatrix NormalPattern::normal_matrix(const BlockRows& M, std::span<const double> W,
                                         Numbers memory) const {
  const auto size = static_cast<std::size_t>(M.block_size);
  const std::size_t numbers = size * size;
  memory.resize(numbers * blocks_.rows.size());
  BlockMatrix N{&blocks_, M.block_size, std::move(memory)};
  add_products<1>(M, N, [&](std::size_t c) {
    double* diagonal = N.values.data() + numbers * blocks_.starts[c];
    std::fill(diagonal, N.values.data() + numbers * blocks_.starts[c + 1], 0.0);
    if (W.empty()) return;
    for (std::size_t k = 0; k < size; ++k) diagonal[(size + 1) * k] = W[c];
  });
  return N;
}

BlockMatrix NormalPattern::reduced_matrix(const BlockMatrix& A, const BlockRows& G,
                                          Numbers memory) const {
  constexpr std::size_t kNumbers = 9;
  memory.resize(kNumbers * blocks_.rows.size());
  BlockMatrix N{&blocks_, 3, std::move(memory)};
  add_products<-1>(G, N, [&](std::size_t c) {
    for (std::size_t e = blocks_.starts[c]; e < blocks_.starts[c + 1]; ++e) {
      double* block = N.values.data() + kNumbers * e;
      std::fill(block, block + kNumbers, 0.0);
      for (std::size_t k = 0; k < 3; ++k) block[4 * k] = A.values[e];
    }
  });
  return N;
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
