#include "lapwing/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <sched.h>
#include <string_view>
#include <thread>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/worker_pool.h"

namespace lapwing {

namespace {

// With this number, a loop of 2 s on one thread checks for cancellation about every 0.1 s.
constexpr std::size_t kChunksPerThread = 16;

// Returns 0 if the environment variable is not set or invalid.
unsigned wanted_threads() {
  constexpr unsigned kMost = 256;
  const char* const value = std::getenv("LAPWING_THREADS");
  const std::string_view text = value != nullptr ? value : "";
  unsigned wanted = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wanted);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number && wanted <= kMost ? wanted : 0;
}

}  // namespace

unsigned thread_count() {
  static const unsigned count = [] {
    if (const unsigned wanted = wanted_threads(); wanted > 0) return wanted;
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) {
      return static_cast<unsigned>(std::max(1, CPU_COUNT(&allowed)));
    }
    return std::max(1U, std::thread::hardware_concurrency());
  }();
  return count;
}

void parallel_ranges(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t threads = std::min<std::size_t>(thread_count(), (count + grain - 1) / grain);
  // Use more chunks than threads, so that a busy core delays only one chunk, and so that
  // cancellation is checked between chunks.
  const std::size_t chunks = kChunksPerThread * threads;
  const std::size_t chunk = std::max(grain, (count + chunks - 1) / chunks);
  if (threads <= 1) {
    for (std::size_t begin = 0; begin < count; begin += chunk) {
      check_cancelled();
      body(begin, std::min(begin + chunk, count));
    }
    return;
  }
  check_cancelled();
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  LentScope scope;
  const auto take_chunks = [&] {
    for (;;) {
      const std::size_t begin = next.fetch_add(chunk);
      if (begin >= count) return;
      try {
        check_cancelled();
        body(begin, std::min(begin + chunk, count));
      } catch (...) {
        const std::scoped_lock lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        scope.give_up();
        next = count;
      }
    }
  };
  const auto work = [&](int thread) {
    if (thread == 0) return take_chunks();
    const LentScope::Borrowed borrowed(scope);
    take_chunks();
  };
  shared_workers().run(std::cref(work));
  if (failure) {
    check_cancelled();  // an exception of the callback has priority
    std::rethrow_exception(failure);
  }
}

void parallel_pair(const std::function<void()>& here, const std::function<void()>& aside) {
  const auto caught = [](const std::function<void()>& body) {
    try {
      body();
    } catch (...) {
      return std::current_exception();
    }
    return std::exception_ptr();
  };
  std::exception_ptr failure_here;
  std::exception_ptr failure_aside;
  std::atomic<bool> begun{false};
  LentScope scope;
  const auto take_aside = [&] {
    if (!begun.exchange(true)) failure_aside = caught(aside);
  };
  const auto work = [&](int thread) {
    if (thread == 0) {
      failure_here = caught(here);
      if (!failure_here) return take_aside();
      scope.give_up();
    }
    const LentScope::Borrowed borrowed(scope);
    take_aside();
  };
  shared_workers().run(std::cref(work));
  if (failure_here) std::rethrow_exception(failure_here);
  if (failure_aside) {
    check_cancelled();
    std::rethrow_exception(failure_aside);
  }
}

}  // namespace lapwing
