#include "lapwing/solve/block_cholesky/shared_work.h"

#include <thread>

#include "lapwing/base/cancellation.h"

namespace lapwing::cholesky {
namespace {

constexpr int kChunkBits = 24;
constexpr std::uint64_t kChunkMask = (std::uint64_t{1} << kChunkBits) - 1;
// How often a waiting thread searches for a chunk before it yields. These searches take less time
// than a yield.
constexpr int kLooksBeforeYield = 200;

std::uint64_t make_ticket(int phase, int chunks) {
  return static_cast<std::uint64_t>(phase) << (2 * kChunkBits) | static_cast<std::uint64_t>(chunks)
                                                                     << kChunkBits;
}

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

void CancellableWork::poll() {
  if (is_stopped()) return;
  try {
    check_cancelled();
  } catch (...) {
    interruption_ = std::current_exception();
    stopped_ = true;
  }
}

void CancellableWork::rethrow() const {
  if (interruption_) std::rethrow_exception(interruption_);
}

void SharedWork::run(WorkerPool& pool, NodeWork& work, const std::vector<char>& skipped) {
  skipped_ = skipped;
  skipped_.resize(nodes_.size(), 0);
  int unfinished = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].ticket = 0;
    nodes_[i].waiting_for = graph_.predecessor_counts[i];
    if (!skipped_[i]) ++unfinished;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!skipped_[i]) continue;
    for (int s = graph_.successor_starts[i]; s < graph_.successor_starts[i + 1]; ++s) {
      --nodes_[graph_.successors[s]].waiting_for;
    }
  }
  unfinished_nodes_ = unfinished;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!skipped_[i] && nodes_[i].waiting_for == 0) begin_phase(work, static_cast<int>(i), 0);
  }
  pool.run([&](int thread) { work_until_done(work, thread); });
}

void SharedWork::work_until_done(NodeWork& work, int thread) {
  Chunk chunk;
  int looks = 0;
  while (unfinished_nodes_.load(std::memory_order_acquire) > 0) {
    if ((chunk.node >= 0 && claim(chunk.node, chunk)) || claim_any(chunk)) {
      work.run_chunk(chunk.node, chunk.phase, chunk.chunk, thread);
      finish(work, chunk);
      looks = 0;
    } else if (++looks > kLooksBeforeYield) {
      std::this_thread::yield();
    } else {
      pause();
    }
    if (thread == 0) work.poll();
  }
}

bool SharedWork::claim(int node, Chunk& chunk) {
  std::uint64_t ticket = nodes_[node].ticket.load(std::memory_order_acquire);
  while ((ticket & kChunkMask) < ((ticket >> kChunkBits) & kChunkMask)) {
    if (nodes_[node].ticket.compare_exchange_weak(ticket, ticket + 1, std::memory_order_acq_rel,
                                                  std::memory_order_acquire)) {
      chunk = {node, static_cast<int>(ticket >> (2 * kChunkBits)),
               static_cast<int>(ticket & kChunkMask)};
      return true;
    }
  }
  return false;
}

bool SharedWork::claim_any(Chunk& chunk) {
  for (int node = 0; node < graph_.size(); ++node) {
    if (claim(node, chunk)) return true;
  }
  return false;
}

void SharedWork::finish(NodeWork& work, const Chunk& chunk) {
  if (nodes_[chunk.node].unfinished.fetch_sub(1, std::memory_order_acq_rel) > 1) return;
  begin_phase(work, chunk.node, chunk.phase + 1);
}

void SharedWork::begin_phase(NodeWork& work, int node, int phase) {
  const int chunks = work.chunk_count(node, phase);
  if (chunks == 0) {
    node_done(work, node);
    return;
  }
  nodes_[node].unfinished.store(chunks, std::memory_order_relaxed);
  nodes_[node].ticket.store(make_ticket(phase, chunks), std::memory_order_release);
}

void SharedWork::node_done(NodeWork& work, int node) {
  work.node_done(node);
  for (int s = graph_.successor_starts[node]; s < graph_.successor_starts[node + 1]; ++s) {
    const int next = graph_.successors[s];
    if (nodes_[next].waiting_for.fetch_sub(1, std::memory_order_acq_rel) == 1 && !skipped_[next]) {
      begin_phase(work, next, 0);
    }
  }
  unfinished_nodes_.fetch_sub(1, std::memory_order_acq_rel);
}

}  // namespace lapwing::cholesky
