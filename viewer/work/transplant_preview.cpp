#include "work/transplant_preview.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/transplant/loop_curve.h"
#include "lapwing/transplant/placed_part.h"
#include "state/command.h"

namespace lapwing::viewer {

TransplantPreview::TransplantPreview(JobThread::MakeKernels make_kernels,
                                     std::function<void()> wake)
    : job_(std::move(make_kernels), std::move(wake)) {}

void TransplantPreview::follow(const AppState& host, const TransplantStep& step) {
  Wanted wanted{host.rest, step};
  if (wanted_ == wanted) return;
  wanted_ = std::move(wanted);
  result_.reset();
  message_.clear();
  job_.start([host, step](const std::shared_ptr<Kernels>& kernels,
                          const Progress& progress) -> TransplantResult {
    const CutHole hole = cut_hole(step.target_region, *host.rest);
    return {apply_step(host, step, {}, *kernels, progress),
            loop_points(hole.loop, host.rest->positions)};
  });
}

void TransplantPreview::stop() {
  job_.cancel();
  wanted_.reset();
  result_.reset();
  message_.clear();
}

void TransplantPreview::use_kernels(JobThread::MakeKernels make_kernels) {
  job_.use_kernels(std::move(make_kernels));
}

bool TransplantPreview::update() {
  try {
    auto result = job_.take();
    if (!result) return false;
    result_ = std::move(result);
    message_.clear();  // it may report a lost device
  } catch (const Error& error) {
    message_ = error.what();
  }
  return true;
}

}  // namespace lapwing::viewer
