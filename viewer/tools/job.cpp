#include "tools/job.h"

#include <utility>

#include "lapwing/base/errors.h"

namespace lapwing::viewer {

JobThread::JobThread(MakeKernels make_kernels, std::function<void()> wake)
    : wake_(std::move(wake)), make_kernels_(std::move(make_kernels)), worker_([this] { run(); }) {}

JobThread::~JobThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    ++ticket_;
  }
  asked_.notify_one();
  worker_.join();
}

void JobThread::start(Work work) {
  {
    const std::lock_guard lock(mutex_);
    ++ticket_;
    unfinished_ = std::move(work);
    to_start_ = true;
    done_ = false;
    error_ = nullptr;
    status_ = {true, {}, 0.0};
  }
  asked_.notify_one();
}

void JobThread::cancel() {
  const std::lock_guard lock(mutex_);
  ++ticket_;
  unfinished_ = {};
  to_start_ = false;
  done_ = false;
  error_ = nullptr;
  status_ = {};
}

void JobThread::use_kernels(MakeKernels make_kernels) {
  Work again;
  {
    const std::lock_guard lock(mutex_);
    make_kernels_ = std::move(make_kernels);
    again = unfinished_;
  }
  if (again) start(std::move(again));
}

WorkStatus JobThread::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

bool JobThread::take_done() {
  const std::lock_guard lock(mutex_);
  if (!std::exchange(done_, false)) return false;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return true;
}

void JobThread::run() {
  std::unique_lock lock(mutex_);
  for (;;) {
    asked_.wait(lock, [this] { return stop_ || to_start_; });
    if (stop_) return;
    to_start_ = false;
    {
      const Work work = unfinished_;
      const std::uint64_t ticket = ticket_;
      const MakeKernels make_kernels = make_kernels_;
      lock.unlock();
      carry_out(work, ticket, make_kernels);
    }
    if (wake_) wake_();
    lock.lock();
  }
}

void JobThread::carry_out(const Work& work, std::uint64_t ticket, const MakeKernels& make_kernels) {
  const Progress progress = [this, ticket](std::string_view stage, double fraction) {
    {
      const std::lock_guard lock(mutex_);
      if (ticket_ != ticket) return false;
      status_.stage = stage;
      status_.fraction = fraction;
    }
    if (wake_) wake_();
    return true;
  };
  std::exception_ptr error;
  bool finished = true;
  try {
    work(make_kernels(), progress);
  } catch (const Cancelled&) {
    return;  // whoever cancelled has set the status
  } catch (const GpuError&) {
    error = std::current_exception();
    finished = false;  // the device may be lost, and on the next one it goes well
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(mutex_);
  if (ticket_ != ticket) return;
  if (finished) unfinished_ = {};
  status_ = {};
  done_ = true;
  error_ = error;
}

}  // namespace lapwing::viewer
