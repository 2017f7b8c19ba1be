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
  std::string stage;      ///< a name of the engine's stages: "factor"
  double fraction = 0.0;  ///< of the stage
};

/// Carries out one piece of work at a time on a background thread, with kernels made there. Call
/// all members from one other thread, the window's. They return at once, except the destructor,
/// which waits for the end of a stage. `Job` below adds results.
class JobThread {
 public:
  using MakeKernels = std::function<std::unique_ptr<Kernels>()>;
  /// The result may keep the kernels, which nobody else uses afterwards.
  using Work = std::function<void(const std::shared_ptr<Kernels>&, const Progress&)>;

  /// `wake` is called on the worker whenever the status has changed; it must not call back.
  explicit JobThread(MakeKernels make_kernels, std::function<void()> wake = {});
  ~JobThread();
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;

  /// Starts as soon as the worker has stopped its earlier work.
  void start(Work work);
  /// Cancels work under way and drops work that is done and not taken.
  void cancel();
  /// Restarts work under way with other kernels, after the device was lost.
  void use_kernels(MakeKernels make_kernels);

  WorkStatus status() const;

  /// Returns true once after each finished piece of work. Throws its exception, once.
  bool take_done();

 private:
  Worker::Work next();
  void carry_out(const Work& work, std::uint64_t ticket, const MakeKernels& make_kernels);

  // The worker's mutex guards everything but the worker. Work is void unless its ticket is the
  // current one.
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

  /// Takes the arguments of JobThread.
  explicit Job(MakeKernels make_kernels, std::function<void()> wake = {})
      : worker_(std::move(make_kernels), std::move(wake)) {}

  void start(Work work) {
    // Cancelled work may still write to its own slot.
    slot_ = std::make_shared<std::optional<Result>>();
    worker_.start([work = std::move(work), slot = slot_](const std::shared_ptr<Kernels>& kernels,
                                                         const Progress& progress) {
      *slot = work(kernels, progress);
    });
  }
  void cancel() { worker_.cancel(); }
  void use_kernels(MakeKernels make_kernels) { worker_.use_kernels(std::move(make_kernels)); }
  WorkStatus status() const { return worker_.status(); }

  /// Returns the result of the work, once; nothing while it lasts. Throws its exception, once.
  std::optional<Result> take() {
    if (!worker_.take_done()) return std::nullopt;
    return std::move(*slot_);
  }

 private:
  std::shared_ptr<std::optional<Result>> slot_;
  JobThread worker_;
};

}  // namespace lapwing::viewer
