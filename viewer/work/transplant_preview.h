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
  std::vector<Eigen::Vector3d> hole;  ///< the loop that was cut into the surface
};

/// The result of a transplant while the user still changes it, computed in the background.
class TransplantPreview {
 public:
  /// Takes the arguments of JobThread.
  explicit TransplantPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Asks for the result of `step`, which names files by absolute paths, on `host`, which waits for
  /// no result. Does nothing if that was asked for last; otherwise cancels work under way.
  void follow(const AppState& host, const TransplantStep& step);
  /// Drops the request and the result.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Takes finished work. Returns true if there is news. Call this when woken.
  bool update();

  bool is_behind() const { return wanted_ && !result_ && message_.empty(); }
  WorkStatus status() const { return job_.status(); }
  /// Returns the result of the last request; null until it is computed.
  const TransplantResult* result() const { return result_ ? &*result_ : nullptr; }
  /// Says why there is no result; empty if there is one or it is still to come.
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
