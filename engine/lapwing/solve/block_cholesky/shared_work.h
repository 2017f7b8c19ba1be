#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <vector>

#include "lapwing/base/worker_pool.h"
#include "lapwing/solve/block_cholesky/symbolic.h"

namespace lapwing::cholesky {

/// The work at the nodes of a WorkGraph. The work of a node is divided into phases, and each phase
/// into chunks that several threads may run at the same time. A phase begins when all chunks of the
/// previous phase are done.
class NodeWork {
 public:
  virtual ~NodeWork() = default;

  /// Returns the number of chunks of a phase, at least 1 in phase 0. Returns 0 if the node is done.
  virtual int chunk_count(int node, int phase) const = 0;
  virtual void run_chunk(int node, int phase, int chunk, int thread) = 0;
  /// Called when a node is done, before its successors begin.
  virtual void node_done(int /*node*/) {}
  /// Called between chunks and while waiting, only on the thread that called SharedWork::run.
  virtual void poll() {}
};

/// Work that stops if `check_cancelled` throws. `run_chunk` must check `is_stopped` regularly, and
/// the caller of SharedWork::run must then call `rethrow`.
class CancellableWork : public NodeWork {
 public:
  void poll() override;
  bool is_stopped() const { return stopped_.load(std::memory_order_relaxed); }
  void rethrow() const;

 private:
  std::exception_ptr interruption_;
  std::atomic<bool> stopped_ = false;
};

/// Runs all nodes of a graph on a pool, each after its predecessors. A thread takes one chunk at a
/// time, first from the node of its last chunk, then from the first node that has any left. A
/// thread that the system suspends therefore delays only one chunk.
class SharedWork {
 public:
  explicit SharedWork(const WorkGraph& graph) : graph_(graph), nodes_(graph.size()) {}

  /// Runs all nodes except those marked in `skipped`, which count as done. If `skipped` is empty,
  /// runs all nodes.
  void run(WorkerPool& pool, NodeWork& work, const std::vector<char>& skipped);

 private:
  // `ticket` packs the phase, its number of chunks, and the next chunk to be claimed.
  struct alignas(64) Node {
    std::atomic<std::uint64_t> ticket{0};
    std::atomic<int> unfinished{0};  // unfinished chunks of the current phase
    std::atomic<int> waiting_for{0};
  };
  struct Chunk {
    int node = -1;
    int phase = 0;
    int chunk = 0;
  };

  void work_until_done(NodeWork& work, int thread);
  bool claim(int node, Chunk& chunk);
  bool claim_any(Chunk& chunk);
  void finish(NodeWork& work, const Chunk& chunk);
  void begin_phase(NodeWork& work, int node, int phase);
  void node_done(NodeWork& work, int node);

  const WorkGraph& graph_;
  std::vector<Node> nodes_;
  std::vector<char> skipped_;
  std::atomic<int> unfinished_nodes_{0};
};

}  // namespace lapwing::cholesky
