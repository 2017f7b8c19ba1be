#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

namespace lapwing::dissection {

/// Loops of some threads, whose rounds others may take that have nothing else to do.
class SharedLoops {
 public:
  /// Calls round(0), ..., round(count - 1), in any order, here and on threads that call `help`.
  /// Returns when all have returned; rethrows the first error of one, whoever called it.
  void run(std::size_t count, const std::function<void(std::size_t)>& round);

  /// Takes rounds of one loop until it has none left; false where no loop has any.
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
  std::condition_variable ended_;  // a round that another thread had taken
  std::vector<Loop*> loops_;
};

}  // namespace lapwing::dissection
