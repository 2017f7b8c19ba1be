#include "lapwing/solve/dissection/shared_loops.h"

#include <algorithm>

namespace lapwing::dissection {

void SharedLoops::run(std::size_t count, const std::function<void(std::size_t)>& round) {
  if (count == 1) {
    round(0);
    return;
  }
  Loop loop{round, count};
  std::unique_lock lock(mutex_);
  loops_.push_back(&loop);
  take_rounds(loop, lock);
  ended_.wait(lock, [&] { return loop.running == 0; });
  std::erase(loops_, &loop);
  if (loop.error) std::rethrow_exception(loop.error);
}

bool SharedLoops::help() {
  std::unique_lock lock(mutex_);
  const auto open =
      std::find_if(loops_.begin(), loops_.end(), [](const Loop* loop) { return loop->is_open(); });
  if (open == loops_.end()) return false;
  take_rounds(**open, lock);
  return true;
}

void SharedLoops::take_rounds(Loop& loop, std::unique_lock<std::mutex>& lock) {
  while (loop.is_open()) {
    const std::size_t number = loop.next++;
    ++loop.running;
    lock.unlock();
    std::exception_ptr error;
    try {
      loop.round(number);
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    if (error) {
      loop.next = loop.count;
      if (!loop.error) loop.error = error;
    }
    if (--loop.running == 0) ended_.notify_all();
  }
}

}  // namespace lapwing::dissection
