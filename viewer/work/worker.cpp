#include "work/worker.h"

#include <utility>

namespace lapwing::viewer {

Worker::Worker(std::function<Work()> next, std::function<void()> wake)
    : next_(std::move(next)), wake_(std::move(wake)), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  asked_.notify_one();
  thread_.join();
}

void Worker::wake() const {
  if (wake_) wake_();
}

Progress Worker::progress(const std::uint64_t& current, std::uint64_t ticket, Note note,
                          bool wakes) const {
  return [this, &current, ticket, note = std::move(note), wakes](std::string_view stage,
                                                                 double fraction) {
    {
      const std::lock_guard lock(mutex_);
      if (current != ticket) return false;
      note(stage, fraction);
    }
    if (wakes) wake();
    return true;
  };
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    Work work;
    asked_.wait(lock, [&] { return stop_ || (work = next_()) != nullptr; });
    if (stop_) return;
    lock.unlock();
    work();
    work = nullptr;  // release the data of the task without the lock
    wake();
    lock.lock();
  }
}

}  // namespace lapwing::viewer
