#include "lapwing/solve/detached.h"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// An abandoned thread occupies a graph and a processor until it ends.
constexpr int kMostAbandoned = 2;
std::atomic<int> abandoned = 0;

struct DetachedTask {
  std::function<std::vector<int>()> work;
  std::mutex mutex;
  std::condition_variable is_done;
  bool done = false;
  bool abandoned = false;
  std::vector<int> result;
  std::exception_ptr error;

  void run() {
    std::vector<int> made;
    std::exception_ptr thrown;
    try {
      made = work();
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::scoped_lock lock(mutex);
    result = std::move(made);
    error = thrown;
    done = true;
    if (abandoned) --lapwing::abandoned;
    is_done.notify_one();
  }
};

void wait_until_few_are_abandoned() {
  while (abandoned >= kMostAbandoned) {
    std::this_thread::sleep_for(kCheckInterval);
    check_cancelled();
  }
}

void wait_for(DetachedTask& errand) {
  std::unique_lock lock(errand.mutex);
  while (!errand.is_done.wait_for(lock, kCheckInterval, [&] { return errand.done; })) {
    lock.unlock();
    try {
      check_cancelled();
    } catch (...) {
      const std::scoped_lock again(errand.mutex);
      errand.abandoned = !errand.done;
      if (errand.abandoned) ++abandoned;
      throw;
    }
    lock.lock();
  }
}

}  // namespace

std::vector<int> run_detached(std::function<std::vector<int>()> work) {
  if (!can_be_cancelled()) return work();
  wait_until_few_are_abandoned();
  const auto errand = std::make_shared<DetachedTask>();
  errand->work = std::move(work);
  try {
    std::thread([errand] { errand->run(); }).detach();
  } catch (const std::system_error&) {
    return errand->work();
  }
  wait_for(*errand);
  if (errand->error) std::rethrow_exception(errand->error);
  return std::move(errand->result);
}

}  // namespace lapwing
