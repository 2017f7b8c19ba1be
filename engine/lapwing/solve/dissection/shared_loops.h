#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace lapwing::dissection {

/// Loops whose iterations idle threads can help to run.
class SharedLoops {
 public:
  /// Calls round(0), ..., round(count - 1) in any order, on this thread and on threads that call
  /// `help`. Returns when all calls have returned. After the first exception on any thread, skips
  /// the remaining calls and rethrows the exception on this thread.
  void run(std::size_t count, const std::function<void(std::size_t)>& round);

  /// Runs iterations of one loop until none is left. Returns false if no loop has iterations left.
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

  // Runs iterations of `loop` while there are any. `lock` is locked before and after the call.
  void take_rounds(Loop& loop, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable ended_;  // signals that no iteration of a loop is running
  std::vector<Loop*> loops_;
};

}  // namespace lapwing::dissection
