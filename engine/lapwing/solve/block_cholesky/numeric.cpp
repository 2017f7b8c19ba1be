#include "lapwing/solve/block_cholesky/numeric.h"

#include <algorithm>
#include <cstring>

#include "lapwing/solve/block_cholesky/denormals.h"

namespace lapwing::cholesky {
namespace {

constexpr double kReportEveryMs = 2.0;
// Number of strips of an update matrix that one thread computes between two polls: a multiple of
// the widest kernels' tile. In the largest fronts of a million unknowns, they take about 20 ms.
constexpr int kStripsBetweenPolls = 24;
// Pivot strips in a block. One thread factorizes a block while the others compute the rows below
// the previous block.
constexpr int kBlockStrips = 6;
// Number of strips in a chunk: one tile of the widest kernels.
template <typename Real>
constexpr int kChunkStrips = sizeof(Real) == sizeof(double) ? 3 : 6;
// A pivot d_j of at most this fraction of a_jj is rejected (FactorPrecision). If the diagonal is
// scaled to 1, d_j / a_jj is at least the inverse of the condition number. Every matrix with a
// condition number below the inverse of this tolerance therefore passes. The zero pivot of a
// singular matrix is computed with rounding errors, which stay below this tolerance for millions of
// unknowns in double precision.
template <typename Real>
constexpr Real kPivotTolerance = Real(sizeof(Real) == sizeof(double) ? 1e-13 : 1e-6);
// How many matrix blocks ahead of the current one are prefetched.
constexpr std::size_t kPrefetch = 8;

int blocks_of(const Front& front) {
  return (front.pivot_strips + kBlockStrips - 1) / kBlockStrips;
}
template <typename Real>
int chunks_of(int strips) {
  return (strips + kChunkStrips<Real> - 1) / kChunkStrips<Real>;
}

// Returns the first pivot strip of block `block`. For the block after the last, returns the number
// of pivot strips.
int block_start(const Front& front, int block) {
  return std::min(block * kBlockStrips, front.pivot_strips);
}

// Phases of a top front: assemble; factorize the first block of pivots; compute the rows below each
// block (one phase per block); compute the update matrix. In a phase that computes rows, chunk 0
// computes the rows of the next block and factorizes that block.
enum Phase { kAssemble = 0, kFirstPivots = 1, kFirstRows = 2 };

}  // namespace

template <typename Real>
Numeric<Real>::Numeric(const Symbolic& symbolic, const KernelTable<Real>& kernels, WorkerPool& pool)
    : symbolic_(symbolic),
      kernels_(kernels),
      pool_(pool),
      shared_(symbolic.upward),
      stacks_(pool.size()) {
  factor_.reserve(symbolic.factor_size);
  kept_.reserve(symbolic.updates.kept + 2 * kUpdateSlack);
  for (Arena<Real>& stack : stacks_) {
    stack.reserve(symbolic.updates.stacks[0] + symbolic.updates.stacks[1] + 2 * kUpdateSlack);
  }
  floors_.resize(static_cast<std::size_t>(symbolic.blocks) * symbolic.block_size);
}

template <typename Real>
void Numeric<Real>::touch() {
  factor_.touch();
  kept_.touch();
  for (Arena<Real>& stack : stacks_) stack.touch();
}

template <typename Real>
std::size_t Numeric<Real>::bytes_needed(const Symbolic& symbolic, int threads) {
  const std::size_t stacks =
      symbolic.updates.stacks[0] + symbolic.updates.stacks[1] + 2 * kUpdateSlack;
  return arena_bytes<Real>(symbolic.factor_size) +
         arena_bytes<Real>(symbolic.updates.kept + 2 * kUpdateSlack) +
         threads * arena_bytes<Real>(stacks) + sizeof(Real) * symbolic.blocks * symbolic.block_size;
}

template <typename Real>
Refusal Numeric<Real>::factorize(const BlockMatrix& matrix, const Progress& progress,
                                 const std::vector<char>& skipped) {
  matrix_ = &matrix;
  progress_ = &progress;
  stop_at_ = std::numeric_limits<int>::max();
  refusal_ = {};
  interruption_ = nullptr;
  flops_done_ = 0;
  flops_total_ = 0;
  for (int f = 0; f < symbolic_.front_count(); ++f) {
    if (skipped.empty() || !skipped[symbolic_.node_of_front(f)]) {
      flops_total_ += symbolic_.fronts[f].flops;
    }
  }
  report_progress(progress, "factor", 0.0);
  since_report_.restart();
  shared_.run(pool_, *this, skipped);
  if (interruption_) std::rethrow_exception(interruption_);
  if (refusal_.reason == Refusal::Reason::none) report_progress(progress, "factor", 1.0);
  return refusal_;
}

template <typename Real>
FrontView<Real> Numeric<Real>::view(const Front& front) const {
  return {factor_.data() + front.panel_at, front.pivots, front.pivot_strips, front.update_strips};
}

template <typename Real>
int Numeric<Real>::chunk_count(int node, int phase) const {
  if (node < symbolic_.task_count()) return phase == 0 ? 1 : 0;
  const Front& front = symbolic_.fronts[symbolic_.first_top() + node - symbolic_.task_count()];
  const int block = phase - kFirstRows;
  if (phase == kAssemble) return std::min(front.strips(), 4 * pool_.size());
  if (phase == kFirstPivots) return 1;
  if (block < blocks_of(front)) {
    const bool last = block + 1 == blocks_of(front);
    return (last ? 0 : 1) + chunks_of<Real>(front.strips() - block_start(front, block + 2 - last));
  }
  return block == blocks_of(front) ? chunks_of<Real>(front.update_strips) : 0;
}

template <typename Real>
void Numeric<Real>::run_chunk(int node, int phase, int chunk, int thread) {
  [[maybe_unused]] const DenormalsFor<Real> flushed;
  if (node < symbolic_.task_count()) {
    run_task(node, thread);
  } else {
    run_top_chunk(symbolic_.first_top() + node - symbolic_.task_count(), phase, chunk);
  }
}

template <typename Real>
void Numeric<Real>::run_task(int task, int thread) {
  for (int f = symbolic_.task_starts[task]; f < symbolic_.task_starts[task + 1]; ++f) {
    if (abandoned(f)) return;
    run_front(f, thread);
    flops_done_.fetch_add(symbolic_.fronts[f].flops, std::memory_order_relaxed);
    if (thread == 0) poll();
  }
}

template <typename Real>
void Numeric<Real>::run_front(int f, int thread) {
  const Front& front = symbolic_.fronts[f];
  assemble(f, 0, front.strips(), thread);
  if (thread == 0) poll();
  if (abandoned(f)) return;
  factor_pivots(f, 0, front.pivot_strips);
  if (thread == 0) poll();
  if (abandoned(f)) return;
  kernels_.solve_rows(view(front), front.pivot_strips, front.strips(), 0, front.pivot_strips);
  for (int first = 0; first < front.update_strips; first += kStripsBetweenPolls) {
    if (first > 0 && thread == 0) poll();
    if (abandoned(f)) return;
    update(f, first, std::min(first + kStripsBetweenPolls, front.update_strips), thread);
  }
}

template <typename Real>
void Numeric<Real>::run_top_chunk(int f, int phase, int chunk) {
  const Front& front = symbolic_.fronts[f];
  if (phase == kAssemble) {
    const int chunks = chunk_count(symbolic_.node_of_front(f), phase);
    // A refused front is still assembled completely, so that the reported entry does not depend on
    // timing.
    if (!abandoned(f - 1)) {
      assemble(f, front.strips() * chunk / chunks, front.strips() * (chunk + 1) / chunks, 0);
    }
    return;
  }
  if (abandoned(f)) return;
  const int block = phase - kFirstRows;
  if (phase == kFirstPivots) {
    factor_pivots(f, 0, block_start(front, 1));
  } else if (block < blocks_of(front)) {
    const int column = block_start(front, block);
    const int next = block_start(front, block + 1);
    const int after = block_start(front, block + 2);
    const bool has_next = next < front.pivot_strips;
    if (has_next && chunk == 0) {
      kernels_.solve_rows(view(front), next, after, column, next);
      factor_pivots(f, next, after);
    } else {
      const int first =
          (has_next ? after : next) + kChunkStrips<Real> * (chunk - (has_next ? 1 : 0));
      kernels_.solve_rows(view(front), first, std::min(first + kChunkStrips<Real>, front.strips()),
                          column, next);
    }
  } else {
    // Chunk 0 computes the longest strips.
    const int first = kChunkStrips<Real> * (chunks_of<Real>(front.update_strips) - 1 - chunk);
    update(f, first, std::min(first + kChunkStrips<Real>, front.update_strips), 0);
  }
}

template <typename Real>
void Numeric<Real>::assemble(int f, int first_strip, int last_strip, int thread) {
  const Front& front = symbolic_.fronts[f];
  const FrontView<Real> to = view(front);
  Real* begin = strip_at(to, first_strip);
  std::memset(begin, 0, sizeof(Real) * (strip_at(to, last_strip) - begin));
  if (symbolic_.block_size == 3) {
    add_matrix<3>(f, first_strip, last_strip);
  } else {
    add_matrix<1>(f, first_strip, last_strip);
  }
  for (int c = front.children_begin; c < front.children_end; ++c) {
    const Front& child = symbolic_.fronts[symbolic_.children[c]];
    kernels_.add_to_panel(child_update(child, thread, first_strip, last_strip), to);
  }
}

template <typename Real>
template <int kBlock>
void Numeric<Real>::add_matrix(int f, int first_strip, int last_strip) {
  const Front& front = symbolic_.fronts[f];
  const FrontView<Real> to = view(front);
  const int first_row = kStrip * first_strip;
  const int last_row = kStrip * last_strip;
  Real* floors = floors_.data() + static_cast<std::size_t>(kBlock) * front.first_block;
  const double* values = matrix_->values.data();
  for (std::size_t e = front.entries_begin; e < front.entries_end; ++e) {
    const MatrixEntry& entry = symbolic_.entries[e];
    // The matrix is stored in the caller's order, so the next block is seldom in a cache.
    const MatrixEntry& ahead = symbolic_.entries[std::min(e + kPrefetch, front.entries_end - 1)];
    __builtin_prefetch(values + ahead.source * (kBlock * kBlock));
    const bool transposed = entry.row < entry.column;
    const int block_row = std::max(entry.row, entry.column);
    const int block_column = std::min(entry.row, entry.column);
    if (block_row >= last_row || block_row + kBlock <= first_row) continue;
    const double* block = values + entry.source * (kBlock * kBlock);
    double not_finite = 0.0;  // NaN if an entry is not finite
    for (int k = 0; k < kBlock * kBlock; ++k) not_finite += block[k] * 0.0;
    if (not_finite != 0.0) refuse({Refusal::Reason::not_finite, f, entry.source});
    const int row_stride = transposed ? kBlock : 1;
    const int column_stride = transposed ? 1 : kBlock;
    const bool diagonal = block_row == block_column;
    for (int p = 0; p < kBlock; ++p) {
      const int row = block_row + p;
      if (row < first_row || row >= last_row) continue;
      Real* target = strip_at(to, row / kStrip) + static_cast<std::size_t>(kStrip) * block_column +
                     row % kStrip;
      for (int q = 0; q < (diagonal ? p + 1 : kBlock); ++q) {
        target[kStrip * q] = static_cast<Real>(block[p * row_stride + q * column_stride]);
      }
      if (diagonal) floors[row] = std::max(Real(0), kPivotTolerance<Real> * target[kStrip * p]);
    }
  }
}

template <typename Real>
void Numeric<Real>::factor_pivots(int f, int first_strip, int last_strip) {
  const Front& front = symbolic_.fronts[f];
  const Real* floors =
      floors_.data() + static_cast<std::size_t>(symbolic_.block_size) * front.first_block;
  const int refused = kernels_.factor_pivots(view(front), first_strip, last_strip, floors);
  if (refused >= 0) {
    refuse({Refusal::Reason::pivot, f, static_cast<std::size_t>(refused)});
  }
}

template <typename Real>
void Numeric<Real>::update(int f, int first_strip, int last_strip, int thread) {
  const Front& front = symbolic_.fronts[f];
  Real* matrix = update_of(front, thread);
  kernels_.update(view(front), matrix, first_strip, last_strip);
  for (int c = front.children_begin; c < front.children_end; ++c) {
    const Front& child = symbolic_.fronts[symbolic_.children[c]];
    kernels_.add_to_update(child_update(child, thread, front.pivot_strips + first_strip,
                                        front.pivot_strips + last_strip),
                           view(front), matrix);
  }
}

template <typename Real>
Real* Numeric<Real>::update_of(const Front& front, int thread) const {
  if (front.keeps_update) return kept_.data() + kUpdateSlack + front.update_at;
  const std::size_t stack = front.depth_parity == 0 ? 0 : symbolic_.updates.stacks[0];
  return stacks_[thread].data() + kUpdateSlack + stack + front.update_at;
}

template <typename Real>
ChildUpdate<Real> Numeric<Real>::child_update(const Front& child, int thread, int first_target,
                                              int last_target) const {
  const Piece* begin = symbolic_.pieces.data() + child.pieces_begin;
  const Piece* end = symbolic_.pieces.data() + child.pieces_end;
  const auto before = [](const Piece& piece, int target) { return piece.target < target; };
  begin = std::lower_bound(begin, end, first_target, before);
  return {update_of(child, thread),
          symbolic_.positions.data() + child.positions_at,
          child.parent_pivots,
          child.updates,
          begin,
          std::lower_bound(begin, end, last_target, before)};
}

template <typename Real>
void Numeric<Real>::refuse(const Refusal& refusal) {
  const std::scoped_lock lock(refusal_mutex_);
  if (refusal.front > refusal_.front ||
      (refusal.front == refusal_.front && refusal.where >= refusal_.where)) {
    return;
  }
  refusal_ = refusal;
  stop_at_ = std::min(stop_at_.load(), refusal.front);
}

template <typename Real>
void Numeric<Real>::node_done(int node) {
  if (node < symbolic_.task_count()) return;  // run_task counts the fronts of a task
  const Front& front = symbolic_.fronts[symbolic_.first_top() + node - symbolic_.task_count()];
  flops_done_.fetch_add(front.flops, std::memory_order_relaxed);
}

template <typename Real>
void Numeric<Real>::poll() {
  if (interruption_ || since_report_.elapsed_ms() < kReportEveryMs) return;
  try {
    report_progress(*progress_, "factor", std::min(1.0, flops_done_ / flops_total_));
  } catch (...) {
    interruption_ = std::current_exception();
    stop_at_ = -1;
  }
  since_report_.restart();
}

template class Numeric<double>;
template class Numeric<float>;

}  // namespace lapwing::cholesky
