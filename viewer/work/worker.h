#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "lapwing/base/cancellation.h"

namespace lapwing::viewer {

/// A background thread that carries out tasks one after another. The owner stores the requests,
/// guarded by `mutex`, and cancels a task by increasing a ticket number.
class Worker {
 public:
  using Work = std::function<void()>;
  using Note = std::function<void(std::string_view stage, double fraction)>;

  /// `next` returns the next task, or null if there is none. It is called on the thread, with the
  /// mutex locked, after each `notify` and each task. `wake` is called after each task.
  Worker(std::function<Work()> next, std::function<void()> wake);
  /// Waits until the current task ends. The owner must have cancelled it before.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::mutex& mutex() const { return mutex_; }
  void notify() { asked_.notify_one(); }
  void wake() const;

  /// Returns a Progress for a task that started with `ticket`. It cancels the task if `current`,
  /// which the mutex guards, is no longer `ticket`. Otherwise it calls `note` with the mutex
  /// locked, and then `wake` if `wakes` is true.
  Progress progress(const std::uint64_t& current, std::uint64_t ticket, Note note,
                    bool wakes = true) const;

 private:
  void run();

  const std::function<Work()> next_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  bool stop_ = false;
  std::thread thread_;  // declared last, because it uses all other members
};

}  // namespace lapwing::viewer
