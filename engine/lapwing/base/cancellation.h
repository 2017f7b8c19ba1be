#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string_view>

namespace lapwing {

/// Called when a stage of a long operation begins (`fraction` 0) and as it advances (up to 1). In
/// between it is called about every 20 ms with its last arguments. `stage` is a name in the
/// report's `timings_ms`, or empty before the first stage. Return false to cancel: the operation
/// throws `Cancelled` and leaves its inputs unchanged, within 0.2 s on meshes of 400,000 vertices
/// and two cores.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Calls `progress`, or if that is empty checks the current ProgressScope (cancellation.h). Throws
/// `Cancelled` if the answer is false.
void report_progress(const Progress& progress, std::string_view stage, double fraction);

/// Shortest time between two calls of Progress in long loops. A response within 0.2 s feels
/// immediate; this leaves most of that for the work between two checks.
inline constexpr std::chrono::milliseconds kCheckInterval{20};

/// The scope that the checks of a thread use.
struct ScopeInForce {
  class State;
  State* state = nullptr;  ///< of the innermost scope; null for none
  /// On a helper thread: set when the thread that it works for has given up. Null on the thread
  /// that created the scope, the only one that may call Progress.
  const std::atomic<bool>* given_up = nullptr;
};

/// While a ProgressScope exists, `check_cancelled` calls `progress`, also on the threads of
/// `parallel_for` and `parallel_invoke`. Loops without a Progress parameter can thus be cancelled.
/// Every operation with a Progress creates a scope; create one around a call without, such as
/// `read_mesh`. An empty `progress` keeps the enclosing scope in force. `progress` is only called
/// on this thread. Scopes must end in reverse order.
class ProgressScope {
 public:
  explicit ProgressScope(Progress progress);
  ProgressScope(const ProgressScope&) = delete;
  ProgressScope& operator=(const ProgressScope&) = delete;
  ~ProgressScope();

 private:
  ScopeInForce before_;
  ScopeInForce::State* own_ = nullptr;  // null for an empty progress
};

/// Lends the current scope to threads that work for this one.
class LentScope {
 public:
  LentScope();

  /// Tells the helpers that their work is no longer needed.
  void give_up() { given_up_ = true; }

  /// While a Borrowed exists, `check_cancelled` on this thread throws if the lender was cancelled
  /// or has given up.
  class Borrowed {
   public:
    explicit Borrowed(const LentScope& lent);
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed();

   private:
    ScopeInForce before_;
  };

 private:
  ScopeInForce::State* state_;
  std::atomic<bool> given_up_ = false;
};

/// While a CancellationGuard exists, checks on this thread do nothing. The thread can thus finish
/// writing a file.
class CancellationGuard {
 public:
  CancellationGuard();
  CancellationGuard(const CancellationGuard&) = delete;
  CancellationGuard& operator=(const CancellationGuard&) = delete;
  ~CancellationGuard();

 private:
  ScopeInForce before_;
};

/// For long loops, every 0.01 to 10 ms. Calls Progress of the current scope, at most every
/// `kCheckInterval`, and throws Cancelled if that returns false. Does nothing without a scope.
void check_cancelled();

/// For loops with iterations as short as reading a clock: every 256th call checks.
class CancelCheck {
 public:
  void operator()() {
    if (++calls_ % kCalls == 0) check_cancelled();
  }

 private:
  static constexpr unsigned kCalls = 256;
  unsigned calls_ = 0;
};

/// Returns whether `check_cancelled` may throw on this thread.
bool can_be_cancelled();

/// For code that must not throw, such as a thread that waits for its helpers. Calls Progress as
/// `check_cancelled` does; the next `check_cancelled` then throws. Returns false if this thread has
/// no Progress to call.
bool poll_cancelled() noexcept;

/// While one exists, every check of the program calls Progress, regardless of the time. For tests
/// that cancel at every check.
class AskAtEveryCheck {
 public:
  AskAtEveryCheck();
  AskAtEveryCheck(const AskAtEveryCheck&) = delete;
  AskAtEveryCheck& operator=(const AskAtEveryCheck&) = delete;
  ~AskAtEveryCheck();
};

}  // namespace lapwing
