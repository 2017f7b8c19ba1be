#include "lapwing/settle/anderson.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "lapwing/base/instruction_set.h"
#include "lapwing/base/parallel.h"

namespace lapwing {

extern const AndersonLoops kAndersonLoopsBaseline;
#ifdef __x86_64__
extern const AndersonLoops kAndersonLoopsAvx2;
extern const AndersonLoops kAndersonLoopsAvx512;
#endif

namespace {

// Differences that are nearly parallel say nothing: this much of their size is added to each.
constexpr double kRegularization = 1e-12;
// Sums go chunk by chunk, so that they do not depend on the number of threads; the vectors of one
// chunk stay in the first caches.
constexpr std::size_t kChunk = 1024;

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;
using RoughVector = Eigen::Map<Eigen::VectorXf>;

template <typename Body>
void for_chunks(std::size_t size, const Body& body) {
  constexpr std::size_t kChunksPerTask = 8;
  parallel_for(
      (size + kChunk - 1) / kChunk, kChunksPerTask, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
          body(c, c * kChunk, static_cast<Eigen::Index>(std::min(kChunk, size - c * kChunk)));
        }
      });
}

}  // namespace

const AndersonLoops& anderson_loops() {
#ifdef __x86_64__
  const InstructionSet set = available_instruction_sets().front();
  if (set == InstructionSet::avx512) return kAndersonLoopsAvx512;
  if (set == InstructionSet::avx2) return kAndersonLoopsAvx2;
#endif
  return kAndersonLoopsBaseline;
}

Anderson::Anderson(std::size_t size, int window)
    : loops_(anderson_loops()),
      size_(size),
      window_(std::clamp(window, 1, kLargestWindow)),
      last_g_(size),
      last_residual_(size),
      g_differences_(size * static_cast<std::size_t>(window_)),
      residual_differences_(size * static_cast<std::size_t>(window_)),
      partial_((size + kChunk - 1) / kChunk) {}

// Stores the newest differences and their products with the others and with the residual.
void Anderson::take_differences(std::span<const double> x, std::span<const double> g) {
  const bool store = has_last_;
  const int newest = newest_;
  if (store) {
    newest_ = (newest_ + 1) % window_;
    used_ = std::min(used_ + 1, window_);
  }
  for_chunks(size_, [&](std::size_t chunk, std::size_t at, Eigen::Index count) {
    const ConstVector new_g(g.data() + at, count);
    const ConstVector current(x.data() + at, count);
    Vector last_g(last_g_.data() + at, count);
    Vector residual(last_residual_.data() + at, count);
    if (store) {
      RoughVector(column(g_differences_, newest) + at, count) = (new_g - last_g).cast<float>();
      RoughVector(column(residual_differences_, newest) + at, count) =
          (new_g - current - residual).cast<float>();
    }
    last_g = new_g;
    residual = new_g - current;
    Sums& sums = partial_[chunk];
    const float* difference = column(residual_differences_, newest) + at;
    for (int i = 0; i < used_; ++i) {
      loops_.multiply(column(residual_differences_, i) + at, difference, residual.data(),
                      static_cast<std::size_t>(count),
                      sums[static_cast<std::size_t>(kLargestWindow + i)],
                      sums[static_cast<std::size_t>(i)]);
    }
  });
  has_last_ = true;
  const auto last = static_cast<std::size_t>(newest);
  for (std::size_t i = 0; i < static_cast<std::size_t>(used_); ++i) {
    double with_residual = 0.0;
    double with_newest = 0.0;
    for (const Sums& sums : partial_) {
      with_residual += sums[i];
      with_newest += sums[kLargestWindow + i];
    }
    with_residual_[i] = with_residual;
    if (store) products_[i][last] = products_[last][i] = with_newest;
  }
}

// x = g - sum of the differences of g, each times its factor.
void Anderson::combine(std::span<double> x, std::span<const double> g,
                       std::span<const double> factors) {
  for_chunks(size_, [&](std::size_t, std::size_t at, Eigen::Index count) {
    std::copy_n(g.data() + at, count, x.data() + at);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      loops_.subtract(factors[i], column(g_differences_, static_cast<int>(i)) + at, x.data() + at,
                      static_cast<std::size_t>(count));
    }
  });
}

void Anderson::step_back(std::span<double> x) {
  std::copy(last_g_.begin(), last_g_.end(), x.begin());
  restart();
}

void Anderson::advance(std::span<double> x, std::span<const double> g) {
  take_differences(x, g);
  using Small =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kLargestWindow, kLargestWindow>;
  Small A(used_, used_);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kLargestWindow, 1> b(used_);
  for (int i = 0; i < used_; ++i) {
    b[i] = with_residual_[static_cast<std::size_t>(i)];
    for (int j = 0; j < used_; ++j) {
      A(i, j) = products_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    A(i, i) *= 1.0 + kRegularization;
  }
  if (used_ > 0) b = A.ldlt().solve(b).eval();
  const auto used = b.allFinite() ? static_cast<std::size_t>(used_) : 0;
  combine(x, g, std::span(b.data(), used));
}

}  // namespace lapwing
