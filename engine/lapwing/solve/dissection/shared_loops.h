#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace lapwing::dissection {

/// Loops of several threads. Idle threads may take over some of their rounds.
class SharedLoops {
 public:
  /// Calls round(0), ..., round(count - 1), in any order, here and on threads that call `help`.
  /// Returns when all have returned. The first error on any thread skips the remaining rounds and
  /// is rethrown here.
  void run(std::size_t count, const std::function<void(std::size_t)>& round);

  /// Takes rounds of one loop until it has none left. Returns false if no loop has any.
  bool help();

 private:
  struct Loop {
    const std::function<void(std::size_t)>& round;
    std::size_t count;
    std::size_t next = 0;
    int running = 0;
    std::exception_ptr error = nullptr;

    bool is_open() const { return next < count; }
  };

  // Takes rounds while there are any; `lock` is held before and after.
  void take_rounds(Loop& loop, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable ended_;  // no round of a loop is running any more
  std::vector<Loop*> loops_;
};

}  // namespace lapwing::dissection
