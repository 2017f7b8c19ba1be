#include "lapwing/solve/block_cholesky/worker_pool.h"

#include <system_error>

namespace lapwing::cholesky {

WorkerPool::WorkerPool(unsigned threads) {
  helpers_.reserve(threads > 0 ? threads - 1 : 0);
  try {
    for (unsigned t = 1; t < threads; ++t) {
      helpers_.emplace_back([this, t] { help(static_cast<int>(t)); });
    }
  } catch (const std::system_error&) {
    // Fewer threads do the same work.
  } catch (const std::bad_alloc&) {
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::scoped_lock lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void WorkerPool::run(const std::function<void(int)>& job) {
  if (helpers_.empty()) {
    job(0);
    return;
  }
  {
    const std::scoped_lock lock(mutex_);
    job_ = &job;
    ++generation_;
  }
  wake_.notify_all();
  job(0);
  std::unique_lock lock(mutex_);
  job_ = nullptr;
  idle_.wait(lock, [this] { return active_ == 0; });
}

void WorkerPool::help(int thread) {
  unsigned long seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [&] { return quit_ || (job_ != nullptr && generation_ != seen); });
    if (quit_) return;
    seen = generation_;
    const auto& job = *job_;
    ++active_;
    lock.unlock();
    job(thread);
    lock.lock();
    if (--active_ == 0) idle_.notify_one();
  }
}

}  // namespace lapwing::cholesky
