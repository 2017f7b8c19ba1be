#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

#include "lapwing/base/cancellation.h"

namespace lapwing::viewer {

/// A thread that carries out one piece of work after another in the background. The owner holds the
/// requests, guarded by `mutex`, and cancels work by increasing a ticket.
class Worker {
 public:
  using Work = std::function<void()>;
  using Note = std::function<void(std::string_view stage, double fraction)>;

  /// `next` returns the next piece of work, or nothing. It is called on the thread, with the mutex
  /// held, after each `notify` and each piece of work. `wake` is called after each piece.
  Worker(std::function<Work()> next, std::function<void()> wake);
  /// Waits for the end of the work under way, which the owner has cancelled before.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  std::mutex& mutex() const { return mutex_; }
  void notify() { asked_.notify_one(); }
  void wake() const;

  /// Returns a Progress for work under `ticket`. It cancels the work once `current`, guarded by the
  /// mutex, differs. It calls `note` for each stage, with the mutex held, and then wakes the window
  /// if `wakes`.
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
