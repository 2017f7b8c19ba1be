#pragma once

#include <chrono>
#include <pybind11/pybind11.h>
#include <string_view>
#include <thread>

#include "lapwing/base/cancellation.h"

namespace lapwing::python {

/// Progress of an operation that runs without Python's lock. Takes the lock now and then to check
/// for Ctrl+C and to call `heard`, a callable or None, with the stage. An exception from either
/// cancels the operation, and `Interruptible::call` raises it.
class Interruptible {
 public:
  explicit Interruptible(pybind11::object heard) : heard_(std::move(heard)) {}

  /// Runs `operation(progress)` without Python's lock, and takes it again afterwards.
  template <class Operation>
  auto call(const Operation& operation) {
    const Progress progress = [this](std::string_view stage, double fraction) {
      return hear(stage, fraction);
    };
    try {
      const pybind11::gil_scoped_release unlocked;
      const ProgressScope scope(progress);  // also for operations without a Progress
      return operation(progress);
    } catch (const Cancelled&) {
      if (error_) std::rethrow_exception(error_);
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  // Short for a person, but long enough to leave the lock to other threads.
  static constexpr std::chrono::milliseconds kBetween{30};

  bool hear(std::string_view stage, double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - last_ < kBetween) return true;
    last_ = now;
    const pybind11::gil_scoped_acquire locked;
    try {
      if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      if (heard_.is_none()) return true;
      const pybind11::object answer = heard_(pybind11::str(stage.data(), stage.size()), fraction);
      return answer.is_none() || answer.cast<bool>();
    } catch (...) {
      error_ = std::current_exception();
      return false;
    }
  }

  pybind11::object heard_;
  Clock::time_point last_ = Clock::now();
  std::exception_ptr error_;
};

}  // namespace lapwing::python
