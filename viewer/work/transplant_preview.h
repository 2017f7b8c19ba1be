#pragma once

#include <optional>
#include <string>
#include <vector>

#include "state/whole_step.h"
#include "work/job.h"

namespace lapwing::viewer {

/// The result of a transplant.
struct TransplantResult {
  CarriedOut carried_out;
  std::vector<Eigen::Vector3d> hole;  ///< boundary loop of the hole that was cut into the host
};

/// Computes a preview of a transplant in the background while the user edits it.
class TransplantPreview {
 public:
  /// The arguments are those of JobThread.
  explicit TransplantPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Requests the result of `step` on `host`. File paths in `step` must be absolute, and `host`
  /// must not need settling. Does nothing if the last request was the same; otherwise cancels it.
  void follow(const AppState& host, const TransplantStep& step);
  /// Discards the request and the result.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Fetches a finished result. Returns true if the result or the message has changed. Call this
  /// after `wake`.
  bool update();

  bool is_behind() const { return wanted_ && !result_ && message_.empty(); }
  WorkStatus status() const { return job_.status(); }
  /// Returns the result of the last request, or null while it is not computed.
  const TransplantResult* result() const { return result_ ? &*result_ : nullptr; }
  /// Returns the error of the last request, or an empty string if it did not fail.
  const std::string& message() const { return message_; }

 private:
  struct Wanted {
    std::shared_ptr<const Mesh> rest;
    TransplantStep step;
    bool operator==(const Wanted&) const = default;
  };

  std::optional<Wanted> wanted_;
  std::optional<TransplantResult> result_;
  std::string message_;
  Job<TransplantResult> job_;
};

}  // namespace lapwing::viewer
