#include "lapwing/base/worker_pool.h"

#include <chrono>
#include <pthread.h>
#include <sched.h>
#include <system_error>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/parallel.h"

namespace lapwing {
namespace {

using Clock = std::chrono::steady_clock;

// Bit fields of a round, lowest first.
constexpr std::uint64_t kJoined = (std::uint64_t{1} << 32) - 1;
constexpr std::uint64_t kOpen = kJoined + 1;
constexpr std::uint64_t kNextRound = 2 * kOpen;

std::uint64_t number_of(std::uint64_t round) {
  return round / kNextRound;
}

// Returns whether a helper may join `round`, each only once.
bool may_be_joined(std::uint64_t round, std::uint64_t last) {
  return (round & kOpen) != 0 && number_of(round) != last;
}

// Sleeping and waking takes about 50 microseconds, as long as many jobs. Because a new job often
// follows immediately, a waiting thread spins for a while before it sleeps.
constexpr std::chrono::microseconds kHelperLooks{100};
constexpr std::chrono::microseconds kCallerLooks{50};
constexpr int kLooksBetweenClocks = 16;

// Number of SerialScope objects on this thread.
thread_local int alone = 0;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

// Counts the forks between the process that created the first pool and this process.
std::atomic<unsigned> forks{0};

void count_forks() {
  static const int registered = pthread_atfork(nullptr, nullptr, [] { ++forks; });
  static_cast<void>(registered);
}

// Waits until `holds` returns true, at most for `time`. Returns whether it returned true.
template <typename Condition>
bool look_for(std::chrono::microseconds time, const Condition& holds) {
  const Clock::time_point end = Clock::now() + time;
  do {
    for (int look = 0; look < kLooksBetweenClocks; ++look) {
      if (holds()) return true;
      pause();
    }
  } while (Clock::now() < end);
  return false;
}

}  // namespace

WorkerPool::WorkerPool(unsigned threads) {
  count_forks();
  forks_ = forks;
  if (sched_getaffinity(0, sizeof allowed_, &allowed_) != 0) CPU_ZERO(&allowed_);
  helpers_.reserve(threads > 0 ? threads - 1 : 0);
  try {
    for (unsigned t = 1; t < threads; ++t) {
      helpers_.emplace_back([this, t] { help(static_cast<int>(t)); });
    }
  } catch (const std::system_error&) {
    // The pool works with fewer threads.
  } catch (const std::bad_alloc&) {
  }
}

WorkerPool::~WorkerPool() {
  if (is_of_parent()) {
    // The helper threads exist only in the parent process. Joining them, or destroying the
    // condition variables on which they sleep, would block forever. Both are leaked instead.
    static_cast<void>(new std::vector<std::thread>(std::move(helpers_)));
    static_cast<void>(sleep_.release());
    return;
  }
  {
    const std::scoped_lock lock(sleep_->mutex);
    quit_ = true;
  }
  sleep_->wake.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void WorkerPool::run(const std::function<void(int)>& job) {
  if (helpers_.empty() || alone > 0 || is_of_parent() || taken_.exchange(true)) {
    job(0);
    return;
  }
  job_ = &job;
  round_ += kNextRound + kOpen;
  // A helper that goes to sleep after this line has seen the new round.
  if (sleepers_ > 0) {
    keep_helpers_off(sched_getcpu());
    { const std::scoped_lock lock(sleep_->mutex); }
    sleep_->wake.notify_all();
  }
  job(0);
  round_ &= ~kOpen;
  wait_for_helpers();
  taken_ = false;
}

// Returns whether a parent process created the pool. If so, this process has no helper threads.
bool WorkerPool::is_of_parent() const {
  return forks_ != forks;
}

// Keeps helpers off the caller's CPU. On systems that report no shared caches, such as many virtual
// machines, the kernel would schedule a woken thread there, where it would wait for the caller.
void WorkerPool::keep_helpers_off(int processor) {
  if (processor == kept_off_ || processor < 0 || processor >= CPU_SETSIZE) return;
  kept_off_ = processor;
  cpu_set_t others = allowed_;
  CPU_CLR(processor, &others);
  if (CPU_COUNT(&others) == 0) return;
  for (std::thread& helper : helpers_) {
    pthread_setaffinity_np(helper.native_handle(), sizeof others, &others);
  }
}

// Checks for cancellation while it waits, because helpers may take long.
void WorkerPool::wait_for_helpers() {
  const auto all_left = [this] { return (round_ & kJoined) == 0; };
  if (look_for(kCallerLooks, all_left)) return;
  std::unique_lock lock(sleep_->mutex);
  caller_sleeps_ = true;
  while (!sleep_->idle.wait_for(lock, kCheckInterval, all_left)) {
    lock.unlock();
    poll_cancelled();
    lock.lock();
  }
  caller_sleeps_ = false;
}

void WorkerPool::help(int thread) {
  std::uint64_t last = 0;
  const auto sees_work = [&] { return quit_ || may_be_joined(round_, last); };
  for (;;) {
    if (!look_for(kHelperLooks, sees_work)) {
      std::unique_lock lock(sleep_->mutex);
      ++sleepers_;
      sleep_->wake.wait(lock, sees_work);
      --sleepers_;
    }
    if (quit_) return;
    if (!join(last)) continue;
    (*job_)(thread);
    leave();
  }
}

// Returns false if the round was closed in the meantime.
bool WorkerPool::join(std::uint64_t& last) {
  std::uint64_t round = round_;
  while (may_be_joined(round, last)) {
    if (round_.compare_exchange_weak(round, round + 1)) {
      last = number_of(round);
      return true;
    }
  }
  return false;
}

void WorkerPool::leave() {
  const std::uint64_t before = round_.fetch_sub(1);
  if ((before & kJoined) > 1 || !caller_sleeps_) return;
  { const std::scoped_lock lock(sleep_->mutex); }
  sleep_->idle.notify_one();
}

SerialScope::SerialScope() {
  ++alone;
}

SerialScope::~SerialScope() {
  --alone;
}

WorkerPool& shared_workers() {
  static WorkerPool pool(thread_count());
  return pool;
}

}  // namespace lapwing
