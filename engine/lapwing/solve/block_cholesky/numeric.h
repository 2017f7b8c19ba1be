#pragma once

#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/stopwatch.h"
#include "lapwing/solve/block_cholesky/arena.h"
#include "lapwing/solve/block_cholesky/kernels.h"
#include "lapwing/solve/block_cholesky/shared_work.h"

namespace lapwing::cholesky {

/// The reason and location of the failure of a factorization.
struct Refusal {
  enum class Reason { none, pivot, not_finite } reason = Reason::none;
  int front = std::numeric_limits<int>::max();
  /// If `reason` is `pivot`, the scalar column in the front; otherwise the number of the block in
  /// the pattern.
  std::size_t where = 0;
};

/// The numeric factorization in doubles or floats. Owns the factor and the cached update matrices.
template <typename Real>
class Numeric final : private NodeWork {
 public:
  Numeric(const Symbolic& symbolic, const KernelTable<Real>& kernels, WorkerPool& pool);

  /// Calls Arena::touch for all memory that `factorize` needs.
  void touch();

  /// Returns the number of bytes that `factorize` needs with `threads` threads.
  static std::size_t bytes_needed(const Symbolic& symbolic, int threads);

  /// Factorizes `matrix`. `skipped` marks the nodes of the upward graph whose results of the last
  /// call are still valid. Returns the refusal in the earliest front; it does not depend on the
  /// number of threads. Throws Cancelled, and the exceptions of `progress`.
  Refusal factorize(const BlockMatrix& matrix, const Progress& progress,
                    const std::vector<char>& skipped);

  /// Returns the part of the factor that `front` computed.
  FrontView<Real> view(const Front& front) const;

 private:
  int chunk_count(int node, int phase) const override;
  void run_chunk(int node, int phase, int chunk, int thread) override;
  void node_done(int node) override;
  void poll() override;

  void run_task(int task, int thread);
  void run_front(int f, int thread);
  void run_top_chunk(int f, int phase, int chunk);
  void assemble(int f, int first_strip, int last_strip, int thread);
  template <int kBlock>
  void add_matrix(int f, int first_strip, int last_strip);
  void factor_pivots(int f, int first_strip, int last_strip);
  void update(int f, int first_strip, int last_strip, int thread);
  Real* update_of(const Front& front, int thread) const;
  ChildUpdate<Real> child_update(const Front& child, int thread, int first_target,
                                 int last_target) const;
  void refuse(const Refusal& refusal);
  bool abandoned(int front) const { return front >= stop_at_.load(std::memory_order_relaxed); }

  const Symbolic& symbolic_;
  const KernelTable<Real>& kernels_;
  WorkerPool& pool_;
  SharedWork shared_;
  Arena<Real> factor_;
  Arena<Real> kept_;
  std::vector<Arena<Real>> stacks_;  // one per thread
  std::vector<Real> floors_;         // lower bound of each pivot, by scalar column

  const BlockMatrix* matrix_ = nullptr;
  // Fronts with this or a higher number need not be computed, because this front was refused or the
  // call was interrupted.
  std::atomic<int> stop_at_{0};
  std::mutex refusal_mutex_;
  Refusal refusal_;

  const Progress* progress_ = nullptr;
  std::exception_ptr interruption_;  // Cancelled, or the exception of the callback
  std::atomic<double> flops_done_{0};
  double flops_total_ = 0;
  Stopwatch since_report_;
};

}  // namespace lapwing::cholesky
