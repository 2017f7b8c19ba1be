// Based on: Nocedal, "Updating Quasi-Newton Matrices with Limited Storage", 1980; with the first
// Hessian of Liu, Bouaziz, Kavan, "Quasi-Newton Methods for Real-Time Simulation of Hyperelastic
// Materials", 2017.
#include "lapwing/elastic/lbfgs_history.h"

#include <algorithm>
#include <cmath>

#include "lapwing/base/parallel.h"

namespace lapwing {

extern const HistoryLoops kHistoryLoopsBaseline;
#ifdef __x86_64__
extern const HistoryLoops kHistoryLoopsAvx2;
extern const HistoryLoops kHistoryLoopsAvx512;
#endif

namespace {

// A step is not added if the cosine of the angle between the step and its gradient change is at
// most this value: the change then shows rounding errors or negative curvature.
constexpr double kSmallestCurvature = 1e-12;
// Sums are computed chunk by chunk. They therefore do not depend on the number of threads, and the
// vectors of a chunk remain in the cache.
constexpr std::size_t kChunk = 1024;

template <typename Body>
void for_chunks(std::size_t size, const Body& body) {
  constexpr std::size_t kChunksPerTask = 2;
  parallel_for((size + kChunk - 1) / kChunk, kChunksPerTask,
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t c = begin; c < end; ++c) {
                   body(c, c * kChunk, std::min(kChunk, size - c * kChunk));
                 }
               });
}

}  // namespace

const HistoryLoops& history_loops([[maybe_unused]] InstructionSet set) {
#ifdef __x86_64__
  if (set == InstructionSet::avx512) return kHistoryLoopsAvx512;
  if (set == InstructionSet::avx2) return kHistoryLoopsAvx2;
#endif
  return kHistoryLoopsBaseline;
}

Lbfgs::Lbfgs(std::size_t size, int window, double length)
    : loops_(history_loops(available_instruction_sets().front())),
      size_(size),
      window_(std::clamp(window, 1, kLargestWindow)),
      scale_(std::ldexp(1.0, -std::ilogb(length))),
      steps_(size * static_cast<std::size_t>(window_)),
      changes_(size * static_cast<std::size_t>(window_)),
      partial_((size + kChunk - 1) / kChunk) {}

void Lbfgs::Sums::operator+=(const Sums& other) {
  for (std::size_t i = 0; i < kLargestWindow; ++i) {
    first[i] += other.first[i];
    second[i] += other.second[i];
  }
  step_square += other.step_square;
  change_square += other.change_square;
}

Lbfgs::Sums Lbfgs::sum_of_chunks() const {
  Sums all;
  for (const Sums& sums : partial_) all += sums;
  return all;
}

void Lbfgs::add(std::span<const double> last_x, std::span<const double> x,
                std::span<const double> last_g, std::span<const double> g) {
  const auto place = static_cast<std::size_t>((newest_ + 1) % window_);
  const std::size_t others = static_cast<std::size_t>(std::min(used_, window_ - 1));
  float* const new_step = at(steps_, place);
  float* const new_change = at(changes_, place);
  const auto other = [&](std::size_t k) { return slot(static_cast<int>(k)); };
  for_chunks(size_, [&](std::size_t chunk, std::size_t from, std::size_t count) {
    for (std::size_t i = from; i < from + count; ++i) {
      new_step[i] = static_cast<float>(scale_ * (x[i] - last_x[i]));
      new_change[i] = static_cast<float>(scale_ * (g[i] - last_g[i]));
    }
    Sums& sums = partial_[chunk];
    sums = {};
    sums.first[place] = loops_.dot(new_step + from, new_change + from, count);
    sums.step_square = loops_.dot(new_step + from, new_step + from, count);
    sums.change_square = loops_.dot(new_change + from, new_change + from, count);
    for (std::size_t k = 0; k < others; ++k) {
      const std::size_t i = other(k);
      sums.first[i] = loops_.dot(at(steps_, i) + from, new_change + from, count);
      sums.second[i] = loops_.dot(at(changes_, i) + from, new_step + from, count);
    }
  });
  const Sums sums = sum_of_chunks();
  if (!(sums.first[place] >
        kSmallestCurvature * std::sqrt(sums.step_square * sums.change_square))) {
    // The slot may have contained the oldest step, which is now lost.
    used_ = std::min(used_, window_ - 1);
    return;
  }
  for (std::size_t k = 0; k < others; ++k) {
    const std::size_t i = other(k);
    products_[i][place] = sums.first[i];
    products_[place][i] = sums.second[i];
  }
  products_[place][place] = sums.first[place];
  newest_ = static_cast<int>(place);
  used_ = std::min(used_ + 1, window_);
}

void Lbfgs::combine(std::span<double> x, std::vector<float>& columns) {
  for_chunks(size_, [&](std::size_t, std::size_t from, std::size_t count) {
    for (int k = 0; k < used_; ++k) {
      const std::size_t i = slot(k);
      loops_.subtract(factors_[i], at(columns, i) + from, x.data() + from, count);
    }
  });
}

// alpha_i = s_i . (g - sum over newer j of alpha_j y_j) / (s_i . y_i), for step s and change y.
void Lbfgs::first_loop(std::span<const double> g, std::span<double> p) {
  for_chunks(size_, [&](std::size_t chunk, std::size_t from, std::size_t count) {
    partial_[chunk] = {};
    for (int k = 0; k < used_; ++k) {
      const std::size_t i = slot(k);
      partial_[chunk].first[i] = loops_.multiply(at(steps_, i) + from, g.data() + from, count);
    }
    std::copy_n(g.data() + from, count, p.data() + from);
  });
  const Sums sums = sum_of_chunks();
  for (int k = 0; k < used_; ++k) {
    const std::size_t i = slot(k);
    double sum = sums.first[i];
    for (int newer = 0; newer < k; ++newer) {
      sum -= factors_[slot(newer)] * products_[i][slot(newer)];
    }
    factors_[i] = sum / products_[i][i];
  }
  combine(p, changes_);
}

// p += sum_i (alpha_i - beta_i) s_i with beta_i = y_i . (p plus the terms of older steps) / s_i .
// y_i.
void Lbfgs::second_loop(std::span<double> p) {
  for_chunks(size_, [&](std::size_t chunk, std::size_t from, std::size_t count) {
    partial_[chunk] = {};
    for (int k = 0; k < used_; ++k) {
      const std::size_t i = slot(k);
      partial_[chunk].first[i] = loops_.multiply(at(changes_, i) + from, p.data() + from, count);
    }
  });
  const Sums sums = sum_of_chunks();
  for (int k = used_ - 1; k >= 0; --k) {
    const std::size_t i = slot(k);
    double sum = sums.first[i];
    for (int older = k + 1; older < used_; ++older) {
      sum -= factors_[slot(older)] * products_[slot(older)][i];
    }
    factors_[i] = sum / products_[i][i] - factors_[i];  // beta - alpha, which `combine` subtracts
  }
  combine(p, steps_);
}

}  // namespace lapwing
