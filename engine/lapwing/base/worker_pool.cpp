#include "lapwing/base/worker_pool.h"

#include <system_error>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

// Jobs come in rows. Waking from sleep takes about 50 microseconds; a helper that looks around for
// as long before it sleeps is there when the next job comes.
constexpr int kLooksBeforeSleep = 1000;

// How many WorkAlone there are on this thread.
thread_local int alone = 0;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

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
  if (helpers_.empty() || alone > 0 || taken_.exchange(true, std::memory_order_acquire)) {
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
  {
    std::unique_lock lock(mutex_);
    job_ = nullptr;
    wait_for_helpers(lock);
  }
  taken_.store(false, std::memory_order_release);
}

// Meanwhile the caller is asked whether to go on: what the helpers are at may take long.
void WorkerPool::wait_for_helpers(std::unique_lock<std::mutex>& lock) {
  while (!idle_.wait_for(lock, kAskEvery, [this] { return active_ == 0; })) {
    lock.unlock();
    ask_whether_cancelled();
    lock.lock();
  }
}

void WorkerPool::help(int thread) {
  unsigned long seen = 0;
  for (;;) {
    for (int look = 0; look < kLooksBeforeSleep && generation_ == seen && !quit_; ++look) pause();
    std::unique_lock lock(mutex_);
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

WorkAlone::WorkAlone() {
  ++alone;
}

WorkAlone::~WorkAlone() {
  --alone;
}

WorkerPool& shared_workers() {
  static WorkerPool pool(thread_count());
  return pool;
}

}  // namespace lapwing
