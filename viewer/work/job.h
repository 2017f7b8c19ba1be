#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lapwing/kernels/kernels.h"
#include "work/worker.h"

namespace lapwing::viewer {

/// The state of background work, for a progress bar and a line of text.
struct WorkStatus {
  bool busy = false;
  std::string stage;      ///< name of the engine's current stage, such as "factor"
  double fraction = 0.0;  ///< completed fraction of the stage, 0 to 1
};

/// Carries out one task at a time on a background thread, which also creates the kernels. Call all
/// members from the window's thread. They do not block, except the destructor, which waits until
/// the current stage is finished. `Job` is a JobThread whose task has a result.
class JobThread {
 public:
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// A task. Its result may own the kernels, because no other code uses them afterwards.
  using Work = std::function<void(const std::shared_ptr<Kernels>&, const Progress&)>;

  /// `wake` is called on the worker whenever the status has changed. It must not call this object.
  explicit JobThread(MakeKernels make_kernels, std::function<void()> wake = {});
  ~JobThread();
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// Cancels the previous task. The new task starts as soon as the worker has stopped.
  void start(Work work);
  /// Cancels the current task, or discards the result of a finished one.
  void cancel();
  /// Uses other kernels from then on, and restarts an unfinished task. Call this after the device
  /// was lost.
  void use_kernels(MakeKernels make_kernels);

  WorkStatus status() const;

  /// Returns true once after the task has finished. If the task has thrown an exception, rethrows
  /// it once.
  bool take_done();

 private:
  Worker::Work next();
  void carry_out(const Work& work, std::uint64_t ticket, const MakeKernels& make_kernels);

  // The worker's mutex guards the following members. The result of a task is discarded if its
  // ticket is no longer the current one.
  MakeKernels make_kernels_;
  std::uint64_t ticket_ = 0;
  Work unfinished_;  // the current task, or a task that failed because the device was lost
  bool to_start_ = false;
  bool done_ = false;
  std::exception_ptr error_;
  WorkStatus status_;

  Worker worker_;  // declared last, because it uses all other members
};

/// A JobThread whose task has a result.
template <class Result>
class Job {
 public:
  using MakeKernels = JobThread::MakeKernels;
  using Work = std::function<Result(const std::shared_ptr<Kernels>&, const Progress&)>;

  /// The arguments are those of JobThread.
  explicit Job(MakeKernels make_kernels, std::function<void()> wake = {})
      : worker_(std::move(make_kernels), std::move(wake)) {}

  void start(Work work) {
    // A cancelled task may still write its result, so each task has a separate slot.
    slot_ = std::make_shared<std::optional<Result>>();
    worker_.start([work = std::move(work), slot = slot_](const std::shared_ptr<Kernels>& kernels,
                                                         const Progress& progress) {
      *slot = work(kernels, progress);
    });
  }
  void cancel() {
    worker_.cancel();
    slot_.reset();
  }
  void use_kernels(MakeKernels make_kernels) { worker_.use_kernels(std::move(make_kernels)); }
  WorkStatus status() const { return worker_.status(); }

  /// Returns the result once after the task has finished; otherwise returns nullopt. If the task
  /// has thrown an exception, rethrows it once.
  std::optional<Result> take() {
    if (!worker_.take_done()) return std::nullopt;
    return std::move(*slot_);
  }

 private:
  std::shared_ptr<std::optional<Result>> slot_;
  JobThread worker_;
};

}  // namespace lapwing::viewer
