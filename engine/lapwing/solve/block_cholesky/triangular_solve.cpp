#include "lapwing/solve/block_cholesky/triangular_solve.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <type_traits>

#include "lapwing/solve/block_cholesky/denormals.h"

namespace lapwing::cholesky {
namespace {

// Smallest part of the factor that a chunk processes, as a count of numbers.
constexpr std::size_t kSmallestChunk = 8192;

// Whether right-hand sides are scaled, because their values may be out of the range of Real.
template <typename Real>
constexpr bool kIsScaled = sizeof(Real) < sizeof(double);

// Returns the power of two that scales the largest absolute value of a right-hand side to between 1
// and 2.
double scale_of(std::span<const double> column) {
  double largest = 0.0;
  for (const double number : column) largest = std::max(largest, std::abs(number));
  if (!(largest >= std::numeric_limits<double>::min()) || !std::isfinite(largest)) return 1.0;
  // A denormal scale would be flushed to 0.
  return std::ldexp(1.0, -std::min(std::ilogb(largest), 1000));
}

struct Sizes {
  std::size_t solution, kept, stack, scratch;
};

Sizes sizes_for(const Symbolic& symbolic, std::size_t most_pivots, std::size_t most_updates,
                std::size_t width) {
  return {static_cast<std::size_t>(symbolic.blocks) * symbolic.block_size * width,
          symbolic.vectors.kept * width,
          (symbolic.vectors.stacks[0] + symbolic.vectors.stacks[1]) * width,
          (most_pivots + most_updates) * width + kStrip * most_pivots};
}

std::size_t padded_pivots(const Front& front) {
  return static_cast<std::size_t>(kStrip) * front.pivot_strips;
}
std::size_t padded_updates(const Front& front) {
  return static_cast<std::size_t>(kStrip) * front.update_strips;
}

// Calls `body` with the width as a compile-time constant, so that rows are copied in registers.
template <typename Body>
void with_width(int width, const Body& body) {
  static_assert(std::size(kSolveWidths) == 4);
  switch (width) {
    case kSolveWidths[1]:
      return body(std::integral_constant<std::size_t, kSolveWidths[1]>());
    case kSolveWidths[2]:
      return body(std::integral_constant<std::size_t, kSolveWidths[2]>());
    case kSolveWidths[3]:
      return body(std::integral_constant<std::size_t, kSolveWidths[3]>());
    default:
      return body(std::integral_constant<std::size_t, kSolveWidths[0]>());
  }
}

template <typename Padded>
std::size_t most(const Symbolic& symbolic, Padded padded) {
  std::size_t result = 0;
  for (const Front& front : symbolic.fronts) result = std::max(result, padded(front));
  return result;
}

}  // namespace

// Solves L Y = B; children come before parents.
template <typename Real>
class TriangularSolve<Real>::Forward final : public CancellableWork {
 public:
  explicit Forward(const TriangularSolve& solve) : s_(solve) {}

  int chunk_count(int node, int phase) const override {
    if (phase == 0) return 1;
    const Front* top = s_.symbolic_.top_front(node);
    if (phase > 1 || top == nullptr || top->update_strips == 0) return 0;
    return s_.chunks_for(*top, top->update_strips);
  }

  void run_chunk(int node, int phase, int chunk, int thread) override {
    if (is_stopped()) return;
    [[maybe_unused]] const DenormalsFor<Real> flushed;
    const Front* top = s_.symbolic_.top_front(node);
    if (top == nullptr) {
      const auto& starts = s_.symbolic_.task_starts;
      for (int f = starts[node]; f < starts[node + 1]; ++f) {
        const Front& front = s_.symbolic_.fronts[f];
        pivots(front, thread);
        updates(front, 0, front.update_strips, thread);
        if (thread == 0) poll();
        if (is_stopped()) return;
      }
    } else if (phase == 0) {
      pivots(*top, thread);
    } else {
      const int chunks = chunk_count(node, phase);
      updates(*top, top->update_strips * chunk / chunks, top->update_strips * (chunk + 1) / chunks,
              thread);
    }
  }

 private:
  void pivots(const Front& front, int thread) const {
    const auto width = static_cast<std::size_t>(s_.width_);
    Real* y = s_.scratch_[thread].data();
    Real* w = s_.update_rows(front, thread);
    s_.load_pivots(front, y);
    std::fill_n(w, padded_updates(front) * width, Real(0));
    for (int c = front.children_begin; c < front.children_end; ++c) {
      const Front& child = s_.symbolic_.fronts[s_.symbolic_.children[c]];
      add_child(child, s_.update_rows(child, thread), front, y, w);
    }
    s_.solve_->forward_pivots(s_.numeric_.view(front), y);
    std::copy_n(y, front.pivots * width, s_.own_rows(front));
  }

  void add_child(const Front& child, const Real* from, const Front& front, Real* y, Real* w) const {
    const int* position = s_.symbolic_.positions.data() + child.positions_at;
    const int first_update = static_cast<int>(padded_pivots(front));
    if (s_.width_ == 1) {
      for (int k = 0; k < child.parent_pivots; ++k) y[position[k]] += from[k];
      for (int k = child.parent_pivots; k < child.updates; ++k) {
        w[position[k] - first_update] += from[k];
      }
      return;
    }
    with_width(s_.width_, [&](auto width) {
      for (int k = 0; k < child.updates; ++k) {
        Real* to = k < child.parent_pivots ? y + position[k] * width
                                           : w + (position[k] - first_update) * width;
        for (std::size_t r = 0; r < width; ++r) to[r] += from[k * width + r];
      }
    });
  }

  void updates(const Front& front, int first, int last, int thread) const {
    s_.solve_->forward_updates(s_.numeric_.view(front), s_.own_rows(front),
                               s_.update_rows(front, thread), first, last);
  }

  const TriangularSolve& s_;
};

// Solves L' X = Y; parents come before children.
template <typename Real>
class TriangularSolve<Real>::Backward final : public CancellableWork {
 public:
  explicit Backward(const TriangularSolve& solve) : s_(solve) {}

  int chunk_count(int node, int phase) const override {
    if (phase == 0) return 1;
    const Front* top = s_.symbolic_.top_front(node);
    if (top == nullptr) return 0;
    if (phase == 1) return s_.chunks_for(*top, top->pivot_strips);
    return phase == 2 ? 1 : 0;
  }

  void run_chunk(int node, int phase, int chunk, int thread) override {
    if (is_stopped()) return;
    [[maybe_unused]] const DenormalsFor<Real> flushed;
    const Front* top = s_.symbolic_.top_front(node);
    if (top == nullptr) {
      const auto& starts = s_.symbolic_.task_starts;
      for (int f = starts[node + 1] - 1; f >= starts[node]; --f) {
        const Front& front = s_.symbolic_.fronts[f];
        Real* w = s_.scratch_[thread].data();
        gather(front, w);
        updates(front, w, 0, front.pivots);
        pivots(front, thread);
        if (thread == 0) poll();
        if (is_stopped()) return;
      }
    } else if (phase == 0) {
      gather(*top, s_.update_rows(*top, thread));
    } else if (phase == 1) {
      const int chunks = chunk_count(node, phase);
      updates(*top, s_.update_rows(*top, thread), kStrip * (top->pivot_strips * chunk / chunks),
              std::min(kStrip * (top->pivot_strips * (chunk + 1) / chunks), top->pivots));
    } else {
      pivots(*top, thread);
    }
  }

 private:
  void gather(const Front& front, Real* w) const {
    const int* rows = s_.symbolic_.rows.data() + front.rows_at;
    const auto b = static_cast<std::size_t>(s_.symbolic_.block_size);
    with_width(s_.width_, [&](auto width) {
      const std::size_t row = b * width;
      for (int k = 0; k < front.update_blocks; ++k) {
        const Real* from = s_.solution_.data() + rows[k] * row;
        Real* to = w + k * row;
        for (std::size_t z = 0; z < b; ++z) {
          for (std::size_t r = 0; r < width; ++r) to[z * width + r] = from[z * width + r];
        }
      }
    });
    const std::size_t filled = front.update_blocks * b * s_.width_;
    std::fill_n(w + filled, padded_updates(front) * s_.width_ - filled, Real(0));
  }

  void updates(const Front& front, const Real* w, int first, int last) const {
    s_.solve_->backward_updates(s_.numeric_.view(front), w, s_.own_rows(front), first, last);
  }

  void pivots(const Front& front, int thread) const {
    const auto width = static_cast<std::size_t>(s_.width_);
    Real* y = s_.scratch_[thread].data();
    Real* sums = y + padded_pivots(front) * width;
    std::copy_n(s_.own_rows(front), front.pivots * width, y);
    std::fill_n(y + front.pivots * width, (padded_pivots(front) - front.pivots) * width, Real(0));
    s_.solve_->backward_pivots(s_.numeric_.view(front), y, sums);
    std::copy_n(y, front.pivots * width, s_.own_rows(front));
    s_.store_pivots(front, y);
  }

  const TriangularSolve& s_;
};

template <typename Real>
TriangularSolve<Real>::TriangularSolve(const Symbolic& symbolic, const Numeric<Real>& numeric,
                                       const KernelTable<Real>& kernels, WorkerPool& pool)
    : symbolic_(symbolic),
      numeric_(numeric),
      kernels_(kernels),
      pool_(pool),
      upward_(symbolic.upward),
      downward_(symbolic.downward),
      most_pivots_(most(symbolic, padded_pivots)),
      most_updates_(most(symbolic, padded_updates)),
      stacks_(pool.size()),
      scratch_(pool.size()) {}

template <typename Real>
std::size_t TriangularSolve<Real>::bytes_needed(const Symbolic& symbolic, int threads) {
  const Sizes sizes = sizes_for(symbolic, most(symbolic, padded_pivots),
                                most(symbolic, padded_updates), kWidestSolve);
  return arena_bytes<Real>(sizes.solution) + arena_bytes<Real>(sizes.kept) +
         threads * (arena_bytes<Real>(sizes.stack) + arena_bytes<Real>(sizes.scratch));
}

template <typename Real>
void TriangularSolve<Real>::solve(std::span<const double> B, std::span<double> X,
                                  std::size_t columns, std::span<const Index> places) {
  const std::size_t size = static_cast<std::size_t>(symbolic_.blocks) * symbolic_.block_size;
  for (std::size_t first = 0; first < columns; first += kWidestSolve) {
    const std::size_t count = std::min<std::size_t>(columns - first, kWidestSolve);
    solve_columns(
        {B.data() + first * size, X.data() + first * size, static_cast<int>(count), places, {}});
  }
}

template <typename Real>
void TriangularSolve<Real>::solve_columns(Columns columns) {
  const auto* width =
      std::lower_bound(std::begin(kSolveWidths), std::end(kSolveWidths), columns.count);
  reserve(*width);
  width_ = *width;
  solve_ = &kernels_.solve[width - std::begin(kSolveWidths)];
  if constexpr (kIsScaled<Real>) {
    const std::size_t size = static_cast<std::size_t>(symbolic_.blocks) * symbolic_.block_size;
    for (int r = 0; r < columns.count; ++r) {
      columns.scales[r] = scale_of({columns.B + r * size, size});
    }
  }
  columns_ = columns;
  Forward forward(*this);
  upward_.run(pool_, forward, {});
  forward.rethrow();
  Backward backward(*this);
  downward_.run(pool_, backward, {});
  backward.rethrow();
}

template <typename Real>
void TriangularSolve<Real>::reserve(int width) {
  const Sizes sizes = sizes_for(symbolic_, most_pivots_, most_updates_, width);
  solution_.reserve(sizes.solution);
  kept_.reserve(sizes.kept);
  for (Arena<Real>& stack : stacks_) stack.reserve(sizes.stack);
  for (Arena<Real>& scratch : scratch_) scratch.reserve(sizes.scratch);
}

template <typename Real>
Real* TriangularSolve<Real>::update_rows(const Front& front, int thread) const {
  const auto width = static_cast<std::size_t>(width_);
  if (front.keeps_update) return kept_.data() + front.vector_at * width;
  const std::size_t stack = front.depth_parity == 0 ? 0 : symbolic_.vectors.stacks[0];
  return stacks_[thread].data() + (stack + front.vector_at) * width;
}

template <typename Real>
Real* TriangularSolve<Real>::own_rows(const Front& front) const {
  return solution_.data() +
         static_cast<std::size_t>(front.first_block) * symbolic_.block_size * width_;
}

// Calls body(row, place, size) for each pivot block. `row` is its first row in the front, `place`
// its first row in B and X, and `size` its number of rows (a compile-time constant if it is 1).
template <typename Real>
template <typename Body>
void TriangularSolve<Real>::for_pivot_blocks(const Front& front, const Body& body) const {
  const int* order = symbolic_.order.data() + front.first_block;
  const Index* places = columns_.places.empty() ? nullptr : columns_.places.data();
  const auto visit = [&](auto size) {
    for (int j = 0; j < front.pivot_blocks; ++j) {
      const std::size_t place = places != nullptr ? places[order[j]] : static_cast<Index>(order[j]);
      body(j * size, size * place, size);
    }
  };
  if (symbolic_.block_size == 1) return visit(std::integral_constant<std::size_t, 1>());
  visit(static_cast<std::size_t>(symbolic_.block_size));
}

template <typename Real>
void TriangularSolve<Real>::load_pivots(const Front& front, Real* y) const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t column = static_cast<std::size_t>(symbolic_.block_size) * symbolic_.blocks;
  if (static_cast<int>(width) > columns_.count) std::fill_n(y, front.pivots * width, Real(0));
  std::fill_n(y + front.pivots * width, (padded_pivots(front) - front.pivots) * width, Real(0));
  for_pivot_blocks(front, [&](std::size_t row, std::size_t place, auto size) {
    for (int r = 0; r < columns_.count; ++r) {
      const double* from = columns_.B + r * column + place;
      for (std::size_t z = 0; z < size; ++z) {
        double number = from[z];
        if constexpr (kIsScaled<Real>) number *= columns_.scales[r];
        y[(row + z) * width + r] = static_cast<Real>(number);
      }
    }
  });
}

template <typename Real>
void TriangularSolve<Real>::store_pivots(const Front& front, const Real* y) const {
  const auto width = static_cast<std::size_t>(width_);
  const std::size_t column = static_cast<std::size_t>(symbolic_.block_size) * symbolic_.blocks;
  for_pivot_blocks(front, [&](std::size_t row, std::size_t place, auto size) {
    for (int r = 0; r < columns_.count; ++r) {
      double* to = columns_.X + r * column + place;
      for (std::size_t z = 0; z < size; ++z) {
        to[z] = y[(row + z) * width + r];
        if constexpr (kIsScaled<Real>) to[z] /= columns_.scales[r];
      }
    }
  });
}

template <typename Real>
int TriangularSolve<Real>::chunks_for(const Front& front, int pieces) const {
  const std::size_t numbers = padded_updates(front) * front.pivots;
  const auto chunks = static_cast<int>(
      std::min<std::size_t>(numbers / kSmallestChunk, static_cast<std::size_t>(4 * pool_.size())));
  return std::clamp(chunks, 1, std::max(1, pieces));
}

template class TriangularSolve<double>;
template class TriangularSolve<float>;

}  // namespace lapwing::cholesky
