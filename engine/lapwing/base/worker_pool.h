#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <sched.h>
#include <thread>
#include <vector>

namespace lapwing {

/// Threads that wait for work. A job is one function that every thread may call; it must be
/// written so that any number of them, the caller alone included, completes it: a helper that the
/// system wakes late is then never waited for. May be used from several threads: whoever finds the
/// helpers taken, by another thread or by the job it is itself a part of, works alone.
class WorkerPool {
 public:
  /// `threads` counts the caller. Makes do with fewer when the system gives no more.
  explicit WorkerPool(unsigned threads);
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;
  ~WorkerPool();

  int size() const { return static_cast<int>(helpers_.size()) + 1; }

  /// Calls job(t) on the caller with t = 0 and, as they wake, on helpers with t = 1, 2, ...
  /// Returns when the caller's call and all calls that were begun have returned. The job must not
  /// throw. Helpers that sleep are woken on other processors than the caller's. Allocates nothing.
  void run(const std::function<void(int thread)>& job);

 private:
  void help(int thread);
  bool join(std::uint64_t& last);
  void leave();
  void wait_for_helpers();
  void keep_helpers_off(int processor);

  std::atomic<bool> taken_ = false;
  const std::function<void(int)>* job_ = nullptr;
  /// Which job it is, whether helpers may join it, and how many have.
  std::atomic<std::uint64_t> round_ = 0;
  std::atomic<bool> quit_ = false;

  std::mutex mutex_;  ///< of those that sleep
  std::condition_variable wake_;
  std::condition_variable idle_;
  std::atomic<int> sleepers_ = 0;
  std::atomic<bool> caller_sleeps_ = false;
  std::vector<std::thread> helpers_;

  cpu_set_t allowed_;  ///< the processors that the program may use
  int kept_off_ = -1;  ///< the one that helpers may not
};

/// As long as one lives, its thread uses no helpers of any pool: for threads that share the
/// processors by work of their own.
class WorkAlone {
 public:
  WorkAlone();
  WorkAlone(const WorkAlone&) = delete;
  WorkAlone& operator=(const WorkAlone&) = delete;
  ~WorkAlone();
};

/// The pool that the whole program shares, of `thread_count()` threads.
WorkerPool& shared_workers();

}  // namespace lapwing
