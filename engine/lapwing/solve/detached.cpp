#include "lapwing/solve/detached.h"

#include <atomic>
#include <future>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {
namespace {

// An abandoned thread occupies the memory of a graph and a CPU core until it ends.
constexpr int kMostAbandoned = 2;
std::atomic<int> running_threads = 0;
std::atomic<int> awaited_threads = 0;  // all other running threads are abandoned

class Counted {
 public:
  explicit Counted(std::atomic<int>& count) : count_(count) { ++count_; }
  ~Counted() { --count_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<int>& count_;
};

}  // namespace

std::vector<int> run_detached(std::function<std::vector<int>()> work) {
  if (!can_be_cancelled()) return work();
  while (running_threads - awaited_threads >= kMostAbandoned) {
    std::this_thread::sleep_for(kCheckInterval);
    check_cancelled();
  }
  const auto task = std::make_shared<std::packaged_task<std::vector<int>()>>(std::move(work));
  std::future<std::vector<int>> result = task->get_future();
  const Counted awaited(awaited_threads);
  auto running = std::make_shared<Counted>(running_threads);
  try {
    std::thread([task, running = std::move(running)] { (*task)(); }).detach();
  } catch (const std::system_error&) {
    (*task)();
  }
  while (result.wait_for(kCheckInterval) == std::future_status::timeout) check_cancelled();
  return result.get();
}

}  // namespace lapwing
