#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <sched.h>
#include <thread>
#include <vector>

namespace lapwing {

/// Threads that wait for jobs. A job is a function that every thread may call. It must be complete
/// even if only the caller calls it, so that the pool never waits for a helper that wakes late.
/// Thread-safe: if the helpers are busy with the job of another thread or with an enclosing job,
/// the caller works alone. The child of a fork has no helpers, so its threads always work alone.
class WorkerPool {
 public:
  /// `threads` includes the caller. Uses fewer threads if the system refuses to create more.
  explicit WorkerPool(unsigned threads);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls job(0) on the caller and job(1), job(2), ... on helpers when they wake. Returns when all
  /// started calls have returned. The job must not throw. Sleeping helpers wake on other CPUs than
  /// the caller. Does not allocate.
  void run(const std::function<void(int thread)>& job);

 private:
  void help(int thread);
  bool join(std::uint64_t& last);
  void leave();
  void wait_for_helpers();
  void keep_helpers_off(int processor);
  bool is_of_parent() const;

  std::atomic<bool> taken_ = false;
  const std::function<void(int)>* job_ = nullptr;
  /// Bit fields: number of the job, whether helpers may join it, and how many have joined.
  std::atomic<std::uint64_t> round_ = 0;
  std::atomic<bool> quit_ = false;

  /// Sleeping threads wait on these condition variables. The child of a fork must not destroy them.
  struct Sleep {
    std::mutex mutex;
    std::condition_variable wake;
    std::condition_variable idle;
  };
  std::unique_ptr<Sleep> sleep_ = std::make_unique<Sleep>();
  std::atomic<int> sleepers_ = 0;
  std::atomic<bool> caller_sleeps_ = false;
  std::vector<std::thread> helpers_;

  cpu_set_t allowed_;  ///< CPUs that the program may use
  int kept_off_ = -1;  ///< CPU that helpers must not use
  unsigned forks_;     ///< fork count when the pool was created
};

/// While a SerialScope exists, its thread uses no helpers of any pool. For threads that already
/// divide the CPUs among themselves.
class SerialScope {
 public:
  SerialScope();
  SerialScope(const SerialScope&) = delete;
  SerialScope& operator=(const SerialScope&) = delete;
  ~SerialScope();
};

/// Returns the global pool, with `thread_count()` threads.
WorkerPool& shared_workers();

}  // namespace lapwing
