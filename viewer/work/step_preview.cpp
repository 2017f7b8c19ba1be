#include "work/step_preview.h"

#include <utility>

#include "lapwing/base/errors.h"

namespace lapwing::viewer {

StepPreview::StepPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake)
    : job_(std::move(make_kernels), std::move(wake)) {}

void StepPreview::start(const AppState& state, const Step& step) {
  result_.reset();
  message_.clear();
  job_.start([state, step](const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
    CarriedOut out = apply_step(state, step, {}, *kernels, progress);
    // Computed here, because the window's thread would otherwise wait for it.
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&*out.result)) {
      report_progress(progress, "topology", 0.0);
      (*mesh)->topology();
    }
    return out;
  });
}

void StepPreview::stop() {
  job_.cancel();
  result_.reset();
  message_.clear();
}

void StepPreview::use_kernels(JobThread::MakeKernels make_kernels) {
  job_.use_kernels(std::move(make_kernels));
}

bool StepPreview::update() {
  try {
    auto result = job_.take();
    if (!result) return false;
    result_ = std::move(result);
    message_.clear();
  } catch (const Error& error) {
    message_ = error.what();
  }
  return true;
}

std::shared_ptr<const Mesh> StepPreview::mesh() const {
  if (!result_) return nullptr;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&*result_->result);
  return mesh == nullptr ? nullptr : *mesh;
}

}  // namespace lapwing::viewer
