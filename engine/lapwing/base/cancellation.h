#pragma once

#include <atomic>
#include <chrono>

#include "lapwing/base/progress.h"

namespace lapwing {

/// Long loops ask no more often than this. A person takes what answers within 0.2 s for immediate;
/// this leaves most of that for whatever runs between two checks.
inline constexpr std::chrono::milliseconds kAskEvery{20};

/// What a thread's checks go by.
struct ScopeInForce {
  class State;
  State* state = nullptr;  ///< the innermost scope's; null for none
  /// Of a thread that works for another one: set when that one has given up. Null on the thread
  /// that made the scope, which alone may ask it.
  const std::atomic<bool>* given_up = nullptr;
};

/// While one lives, `check_cancelled` on this thread, and on the threads that `parallel_for` and
/// `parallel_invoke` take for it, asks `progress`, so that loops without a Progress of their own
/// can be cancelled too. Every operation that takes a Progress makes one; make one around a call
/// that takes none, such as `read_mesh`. An empty `progress` leaves the scope around this one in
/// force. `progress` is called on this thread alone. Scopes end in the reverse order.
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

/// The scope in force where this is made, lent to threads that work for this one meanwhile.
class LentScope {
 public:
  LentScope();

  /// What they do is not wanted any more.
  void give_up() { given_up_ = true; }

  /// While one lives, `check_cancelled` on this thread throws once the lender has heard "no" or
  /// has given up.
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

/// While one lives, checks on this thread do nothing: what is being written is finished.
class Uncancelled {
 public:
  Uncancelled();
  Uncancelled(const Uncancelled&) = delete;
  Uncancelled& operator=(const Uncancelled&) = delete;
  ~Uncancelled();

 private:
  ScopeInForce before_;
};

/// For loops that may take long, every 0.01 to 10 ms: asks the scope in force, at most every
/// `kAskEvery`, and throws Cancelled when the answer is no. Does nothing where there is no scope.
void check_cancelled();

/// `check_cancelled` for loops whose rounds are as short as reading a clock: every 256th call.
class CancelCheck {
 public:
  void operator()() {
    if (++calls_ % kCalls == 0) check_cancelled();
  }

 private:
  static constexpr unsigned kCalls = 256;
  unsigned calls_ = 0;
};

/// Whether `check_cancelled` may ever throw here.
bool can_be_cancelled();

/// For whoever must not throw, such as a thread that waits for its helpers: asks as
/// `check_cancelled` does, which then throws. False where this thread has nothing to ask.
bool ask_whether_cancelled() noexcept;

/// While one lives, every check of the program asks, whatever the time: for tests that cancel at
/// each point.
class AskAtEveryCheck {
 public:
  AskAtEveryCheck();
  AskAtEveryCheck(const AskAtEveryCheck&) = delete;
  AskAtEveryCheck& operator=(const AskAtEveryCheck&) = delete;
  ~AskAtEveryCheck();
};

}  // namespace lapwing
