#include "lapwing/base/cancellation.h"

#include <atomic>
#include <exception>
#include <string>
#include <utility>

#include "lapwing/base/errors.h"

namespace lapwing {
namespace {

std::atomic<int> always_asking = 0;

thread_local ScopeInForce in_force;

}  // namespace

class ScopeInForce::State {
 public:
  // Before the first stage is reported, the stage of the enclosing scope is used.
  State(Progress progress, const State* around) : progress_(std::move(progress)) {
    if (around != nullptr) note(around->stage_, around->fraction_);
  }

  void note(std::string_view stage, double fraction) {
    stage_ = stage;
    fraction_ = fraction;
    asked_ = Clock::now();
  }

  // Copies the stage of an inner scope, so that the reported fraction never decreases.
  void take_over(State& inside) noexcept {
    stage_.swap(inside.stage_);
    fraction_ = inside.fraction_;
  }

  void ask() noexcept {
    if (stopped_ || asking_) return;
    if (always_asking == 0 && Clock::now() - asked_ < kCheckInterval) return;
    asking_ = true;
    try {
      if (!progress_(stage_, fraction_)) throw Cancelled();
    } catch (...) {
      failure_ = std::current_exception();
      stopped_ = true;
    }
    asking_ = false;
    asked_ = Clock::now();
  }

  // Rethrows the callback's exception on the thread that called the callback.
  void rethrow_if_stopped() const {
    if (stopped_) std::rethrow_exception(failure_);
  }

  void throw_if_stopped() const {
    if (stopped_) throw Cancelled();
  }

 private:
  using Clock = std::chrono::steady_clock;

  const Progress progress_;
  std::string stage_;
  double fraction_ = 0.0;
  Clock::time_point asked_ = Clock::now();
  bool asking_ = false;  // whether the callback is running; it may contain checks
  std::exception_ptr failure_;
  std::atomic<bool> stopped_ = false;
};

ProgressScope::ProgressScope(Progress progress) : before_(in_force) {
  if (!progress) return;
  const bool may_ask = before_.given_up == nullptr;
  own_ = new ScopeInForce::State(std::move(progress), may_ask ? before_.state : nullptr);
  in_force = {own_, nullptr};
}

ProgressScope::~ProgressScope() {
  if (own_ == nullptr) return;
  in_force = before_;
  if (before_.state != nullptr && before_.given_up == nullptr) before_.state->take_over(*own_);
  delete own_;
}

LentScope::LentScope() : state_(in_force.state) {}

LentScope::Borrowed::Borrowed(const LentScope& lent) : before_(in_force) {
  in_force = {lent.state_, &lent.given_up_};
}

LentScope::Borrowed::~Borrowed() {
  in_force = before_;
}

CancellationGuard::CancellationGuard() : before_(in_force) {
  in_force = {};
}

CancellationGuard::~CancellationGuard() {
  in_force = before_;
}

void check_cancelled() {
  const auto [state, given_up] = in_force;
  if (given_up != nullptr) {
    if (*given_up) throw Cancelled();
    if (state != nullptr) state->throw_if_stopped();
  } else if (state != nullptr) {
    state->ask();
    state->rethrow_if_stopped();
  }
}

bool can_be_cancelled() {
  return in_force.state != nullptr;
}

bool poll_cancelled() noexcept {
  if (in_force.state == nullptr || in_force.given_up != nullptr) return false;
  in_force.state->ask();
  return true;
}

void report_progress(const Progress& progress, std::string_view stage, double fraction) {
  if (!progress) return check_cancelled();
  if (in_force.state != nullptr && in_force.given_up == nullptr) {
    in_force.state->note(stage, fraction);
  }
  if (!progress(stage, fraction)) throw Cancelled();
}

AskAtEveryCheck::AskAtEveryCheck() {
  ++always_asking;
}

AskAtEveryCheck::~AskAtEveryCheck() {
  --always_asking;
}

}  // namespace lapwing
