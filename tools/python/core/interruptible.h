#pragma once

#include <chrono>
#include <pybind11/pybind11.h>
#include <string_view>
#include <thread>

#include "lapwing/base/cancellation.h"

namespace lapwing::python {

/// Runs operations without Python's global interpreter lock (GIL). Acquires the GIL at most every
/// 30 ms to check for Ctrl+C and to call `heard`, a callable or None, with the stage and its
/// fraction. If this raises an exception, cancels the operation and rethrows the exception.
class Interruptible {
 public:
  explicit Interruptible(pybind11::object heard) : heard_(std::move(heard)) {}

  /// Releases the GIL while `operation(progress)` runs, and reacquires it afterwards.
  template <class Operation>
  auto call(const Operation& operation) {
    const Progress progress = [this](std::string_view stage, double fraction) {
      return hear(stage, fraction);
    };
    try {
      const pybind11::gil_scoped_release unlocked;
      const ProgressScope scope(progress);  // for functions without a Progress
      return operation(progress);
    } catch (const Cancelled&) {
      if (error_) std::rethrow_exception(error_);
      throw;
    }
  }

 private:
  using Clock = std::chrono::steady_clock;
  // Short enough for users, but long enough for other threads to use the GIL.
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
