#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string_view>

namespace lapwing {

/// Callback of a long operation, called when a stage begins (`fraction` 0) and as it advances (up
/// to 1), and about every 20 ms with the previous arguments. `stage` is a name in the report's
/// `timings_ms`, or empty before the first stage. If it returns false, the operation throws
/// `Cancelled` and leaves its inputs unchanged, within 0.2 s for meshes of 400,000 vertices on two
/// cores.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Calls `progress` or, if it is empty, the callback of the current ProgressScope. Throws
/// `Cancelled` if the callback returns false.
void report_progress(const Progress& progress, std::string_view stage, double fraction);

/// Minimum time between two calls of Progress in long loops. A response within 0.2 s feels
/// immediate; most of it remains for the work between two checks.
inline constexpr std::chrono::milliseconds kCheckInterval{20};

/// The scope that the checks of a thread use.
struct ScopeInForce {
  class State;
  State* state = nullptr;  ///< state of the innermost scope; null for none
  /// On a helper thread: whether the lending thread no longer needs the work. Null on the thread
  /// that created the scope, the only one that may call Progress.
  const std::atomic<bool>* given_up = nullptr;
};

/// While a ProgressScope exists, `check_cancelled` calls `progress`, also on the threads of
/// `parallel_for` and `parallel_invoke`. Loops without a Progress parameter can thus be cancelled.
/// Every operation with a Progress parameter creates a scope; to cancel other calls, such as
/// `read_mesh`, create a scope around them. If `progress` is empty, the enclosing scope remains
/// active. `progress` is only called on this thread. Scopes must end in reverse order.
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

/// Lends the current scope of this thread to helper threads.
class LentScope {
 public:
  LentScope();

  /// Tells the helpers that their work is no longer needed.
  void give_up() { given_up_ = true; }

  /// While a Borrowed exists, `check_cancelled` on this thread throws if the lending scope was
  /// cancelled or `give_up` was called.
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

/// While a CancellationGuard exists, checks on this thread do nothing, so that the thread can
/// finish writing a file.
class CancellationGuard {
 public:
  CancellationGuard();
  CancellationGuard(const CancellationGuard&) = delete;
  CancellationGuard& operator=(const CancellationGuard&) = delete;
  ~CancellationGuard();

 private:
  ScopeInForce before_;
};

/// Calls Progress of the current scope, at most every `kCheckInterval`, and throws Cancelled if it
/// returns false. Does nothing without a scope. Call it every 0.01 to 10 ms in long loops.
void check_cancelled();

/// For loops whose iterations are as short as reading a clock. Every 256th call checks for
/// cancellation.
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
/// `check_cancelled` does; if the operation is cancelled, the next `check_cancelled` throws.
/// Returns false if this thread has no Progress.
bool poll_cancelled() noexcept;

/// While one exists, every check of the program calls Progress, without kCheckInterval. For tests.
class AskAtEveryCheck {
 public:
  AskAtEveryCheck();
  AskAtEveryCheck(const AskAtEveryCheck&) = delete;
  AskAtEveryCheck& operator=(const AskAtEveryCheck&) = delete;
  ~AskAtEveryCheck();
};

}  // namespace lapwing
