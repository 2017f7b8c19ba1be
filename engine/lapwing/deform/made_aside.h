#pragma once

#include <atomic>
#include <chrono>
#include <future>
#include <string_view>
#include <system_error>
#include <utility>

#include "lapwing/base/cancellation.h"

namespace lapwing {

/// Something that a thread of its own makes while its owner goes on. The owner calls from one
/// thread at a time; when it goes, the making is told to stop and waited for, so it is the owner's
/// last member where it uses the others.
template <typename T>
class MadeAside {
 public:
  MadeAside() = default;
  ~MadeAside() { stopped_ = true; }
  MadeAside(const MadeAside&) = delete;
  MadeAside& operator=(const MadeAside&) = delete;

  /// Begins to call `make`, whose checks (check_cancelled) throw once it has to stop. Only the
  /// first call does something.
  template <typename Make>
  void begin(Make make) {
    if (std::exchange(has_begun_, true)) return;
    auto run = [this, make = std::move(make)] {
      const ProgressScope scope([this](std::string_view, double) { return !stopped_; });
      return make();
    };
    try {
      made_ = std::async(std::launch::async, run);
    } catch (const std::system_error&) {
      // Without another thread it is made by whoever takes it.
      made_ = std::async(std::launch::deferred, run);
    }
  }
  /// From `begin` until what was made has been taken.
  bool is_at_work() const { return made_.valid(); }
  /// Whether it is there, to be taken.
  bool is_made() const {
    return is_at_work() && made_.wait_for(std::chrono::seconds(0)) != std::future_status::timeout;
  }
  /// While it is at work. Waits for what is made, and rethrows what making it threw. Throws
  /// Cancelled.
  T take() {
    while (made_.wait_for(kAskEvery) == std::future_status::timeout) check_cancelled();
    return made_.get();
  }

 private:
  bool has_begun_ = false;
  std::atomic<bool> stopped_ = false;
  std::future<T> made_;  // last: it uses the others
};

}  // namespace lapwing
