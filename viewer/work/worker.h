#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "lapwing/base/progress.h"

namespace lapwing::viewer {

/// A thread that carries out one piece of work after the other beside the window. What is wanted is
/// its owner's, guarded by `mutex`; the owner cancels by counting a ticket up.
class Worker {
 public:
  using Work = std::function<void()>;
  using Note = std::function<void(std::string_view stage, double fraction)>;

  /// `next` is called on the thread, the mutex held, after each `notify` and each piece of work:
  /// what to do next, or nothing. `wake` is called after each piece.
  Worker(std::function<Work()> next, std::function<void()> wake);
  /// Waits for the end of what is under way, which the owner has cancelled before.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::mutex& mutex() const { return mutex_; }
  void notify() { asked_.notify_one(); }
  void wake() const;

  /// Of work under `ticket`: it is cancelled once `current`, which the mutex guards, is another
  /// one. `note` hears the stages, the mutex held; then the window is woken where it `wakes`.
  Progress progress(const std::uint64_t& current, std::uint64_t ticket, Note note,
                    bool wakes = true) const;

 private:
  void run();

  const std::function<Work()> next_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  bool stop_ = false;
  std::thread thread_;  // last: it uses all the others
};

}  // namespace lapwing::viewer
