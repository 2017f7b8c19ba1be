#pragma once

#include <optional>
#include <string>
#include <vector>

#include "state/applied_step.h"
#include "work/job.h"

namespace lapwing::viewer {

/// What a transplant came to.
struct TransplantResult {
  CarriedOut carried_out;
  std::vector<Eigen::Vector3d> hole;  ///< the loop that was cut into the surface
};

/// What a transplant comes to while a person still changes it, carried out beside the window.
class TransplantPreview {
 public:
  /// JobThread's.
  explicit TransplantPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake = {});

  /// Wants the result of `step`, which names files by absolute paths, on `host`, which waits for no
  /// result. Nothing happens where that is what was wanted last; else what is under way is given
  /// up.
  void follow(const AppState& host, const TransplantStep& step);
  /// Wants nothing any more.
  void stop();
  void use_kernels(JobThread::MakeKernels make_kernels);

  /// Takes what the worker has. True if there is news. Call it when woken.
  bool update();

  bool is_behind() const { return wanted_ && !result_ && message_.empty(); }
  WorkStatus status() const { return job_.status(); }
  /// Of what was wanted last; null while it is made.
  const TransplantResult* result() const { return result_ ? &*result_ : nullptr; }
  /// Why there is none; empty if there is, or will be.
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
