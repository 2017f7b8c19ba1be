#pragma once

#include <optional>
#include <string>

#include "state/whole_step.h"
#include "work/job.h"

namespace lapwing::viewer {

/// Carries out one step in the background, to show its result before it is applied.
class StepPreview {
 public:
  /// The arguments are those of JobThread.
  explicit StepPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Starts `step` on `state`, which must not need settling. Cancels the previous one.
  void start(const AppState& state, const Step& step);
  /// Cancels the work and discards the result.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Fetches a finished result. Returns true if the result or the message has changed. Call this
  /// after `wake`.
  bool update();

  WorkStatus status() const { return job_.status(); }
  /// Returns the result, or null until it has been computed.
  const CarriedOut* result() const { return result_ ? &*result_ : nullptr; }
  /// Returns the new mesh, or null if there is no result or if it has the same triangles.
  std::shared_ptr<const Mesh> mesh() const;
  /// Returns the error, or an empty string.
  const std::string& message() const { return message_; }

 private:
  std::optional<CarriedOut> result_;
  std::string message_;
  Job<CarriedOut> job_;
};

}  // namespace lapwing::viewer
