#include "work/job.h"

#include <utility>

#include "lapwing/base/cancellation.h"
#include "lapwing/base/errors.h"

namespace lapwing::viewer {

JobThread::JobThread(MakeKernels make_kernels, std::function<void()> wake)
    : make_kernels_(std::move(make_kernels)), worker_([this] { return next(); }, std::move(wake)) {}

JobThread::~JobThread() {
  const std::lock_guard lock(worker_.mutex());
  ++ticket_;
}

void JobThread::start(Work work) {
  {
    const std::lock_guard lock(worker_.mutex());
    ++ticket_;
    unfinished_ = std::move(work);
    to_start_ = true;
    done_ = false;
    error_ = nullptr;
    status_ = {true, {}, 0.0};
  }
  worker_.notify();
}

void JobThread::cancel() {
  const std::lock_guard lock(worker_.mutex());
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
    const std::lock_guard lock(worker_.mutex());
    make_kernels_ = std::move(make_kernels);
    again = unfinished_;
  }
  if (again) start(std::move(again));
}

WorkStatus JobThread::status() const {
  const std::lock_guard lock(worker_.mutex());
  return status_;
}

bool JobThread::take_done() {
  const std::lock_guard lock(worker_.mutex());
  if (!std::exchange(done_, false)) return false;
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  return true;
}

Worker::Work JobThread::next() {
  if (!std::exchange(to_start_, false)) return {};
  return [this, work = unfinished_, ticket = ticket_, make_kernels = make_kernels_] {
    carry_out(work, ticket, make_kernels);
  };
}

void JobThread::carry_out(const Work& work, std::uint64_t ticket, const MakeKernels& make_kernels) {
  const Progress progress =
      worker_.progress(ticket_, ticket, [this](std::string_view stage, double fraction) {
        status_.stage = stage;
        status_.fraction = fraction;
      });
  std::exception_ptr error;
  bool finished = true;
  try {
    const ProgressScope scope(progress);  // for functions without a Progress, such as `read_mesh`
    work(make_kernels(), progress);
  } catch (const Cancelled&) {
    return;  // the call that cancelled the task has already set the status
  } catch (const GpuError&) {
    error = std::current_exception();
    finished = false;  // the device may be lost; `use_kernels` then restarts the task
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(worker_.mutex());
  if (ticket_ != ticket) return;
  if (finished) unfinished_ = {};
  status_ = {};
  done_ = true;
  error_ = error;
}

}  // namespace lapwing::viewer
