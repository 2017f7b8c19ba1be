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

/// What is worked at beside the window, for a progress bar and a line of text.
struct WorkStatus {
  bool busy = false;
  std::string stage;      ///< a name of the engine's stages: "factor"
  double fraction = 0.0;  ///< of the stage
};

/// Carries out one piece of work at a time on a thread of its own, with kernels made there. All
/// members may be called from one other thread, the window's, and return at once, but for the
/// destructor, which waits for the end of a stage. `Job` below gives it results.
class JobThread {
 public:
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// Whatever it leaves behind may hold the kernels, which nobody else uses then.
  using Work = std::function<void(const std::shared_ptr<Kernels>&, const Progress&)>;

  /// `wake` is called on the worker whenever the status has changed; it must not call back.
  explicit JobThread(MakeKernels make_kernels, std::function<void()> wake = {});
  ~JobThread();
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// Begins as soon as the worker has noticed that what it is at is not wanted any more.
  void start(Work work);
  /// Gives up what is under way and what is done and not taken.
  void cancel();
  /// The device was lost: what is under way begins anew with other kernels.
  void use_kernels(MakeKernels make_kernels);

  WorkStatus status() const;

  /// True once after each piece of work that has come to its end. Throws, once, what it threw.
  bool take_done();

 private:
  Worker::Work next();
  void carry_out(const Work& work, std::uint64_t ticket, const MakeKernels& make_kernels);

  // All but the worker is guarded by its mutex. Work under a ticket that is not the current one is
  // void.
  MakeKernels make_kernels_;
  std::uint64_t ticket_ = 0;
  Work unfinished_;  // under way, or ended by a lost device
  bool to_start_ = false;
  bool done_ = false;
  std::exception_ptr error_;
  WorkStatus status_;

  Worker worker_;  // last: it uses all the others
};

/// A JobThread whose work has a result.
template <class Result>
class Job {
 public:
  using MakeKernels = JobThread::MakeKernels;
  using Work = std::function<Result(const std::shared_ptr<Kernels>&, const Progress&)>;

  /// JobThread's.
  explicit Job(MakeKernels make_kernels, std::function<void()> wake = {})
      : worker_(std::move(make_kernels), std::move(wake)) {}

  void start(Work work) {
    // Work that was given up may still be writing to a slot of its own.
    slot_ = std::make_shared<std::optional<Result>>();
    worker_.start([work = std::move(work), slot = slot_](const std::shared_ptr<Kernels>& kernels,
                                                         const Progress& progress) {
      *slot = work(kernels, progress);
    });
  }
  void cancel() { worker_.cancel(); }
  void use_kernels(MakeKernels make_kernels) { worker_.use_kernels(std::move(make_kernels)); }
  WorkStatus status() const { return worker_.status(); }

  /// What the work came to, once; nothing while it lasts. Throws, once, what it threw.
  std::optional<Result> take() {
    if (!worker_.take_done()) return std::nullopt;
    return std::move(*slot_);
  }

 private:
  std::shared_ptr<std::optional<Result>> slot_;
  JobThread worker_;
};

}  // namespace lapwing::viewer
