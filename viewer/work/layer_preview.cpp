#include "work/layer_preview.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/run/run_step.h"
#include "state/command.h"

namespace lapwing::viewer {
namespace {

LayeredRequest layered(const LayerDraft& draft) {
  LayeredRequest request{.sources = {},
                         .target_patch = draft.target_patch,
                         .parameters = draft.parameters,
                         .where = "preview",
                         .transfer = draft.transfer,
                         .handles = draft.handles};
  for (const FileSource& source : draft.all_sources()) request.sources.push_back(source);
  if (draft.operation == LayerDraft::Operation::mix) request.weight = draft.weight;
  return request;
}

bool same_sizes(const LayerDraft& a, const LayerDraft& b) {
  return a.sources[0].detail_size == b.sources[0].detail_size &&
         a.sources[1].detail_size == b.sources[1].detail_size;
}

double amplitude_of(const LayerDraft& draft) {
  return draft.operation == LayerDraft::Operation::coat ? draft.sources[0].amplitude : 1.0;
}

}  // namespace

LayerPreview::LayerPreview(JobThread::MakeKernels make_kernels, std::function<void()> wake)
    : job_(std::move(make_kernels), std::move(wake)) {}

void LayerPreview::follow(std::shared_ptr<const Mesh> target, const LayerDraft& draft) {
  if (wanted_ && wanted_->target == target && wanted_->draft == draft) return;
  wanted_ = Wanted{std::move(target), draft};
}

void LayerPreview::stop() {
  job_.cancel();
  wanted_.reset();
  asked_.reset();
  shown_.reset();
  failed_.reset();
  prepared_.reset();
  positions_.clear();
  message_.clear();
}

void LayerPreview::use_kernels(JobThread::MakeKernels make_kernels) {
  const auto wanted = wanted_;
  stop();
  job_.use_kernels(std::move(make_kernels));
  wanted_ = wanted;
}

std::shared_ptr<const Mesh> LayerPreview::mesh() const {
  return {prepared_, &prepared_->layers->mesh()};
}

const LayeredCoat* LayerPreview::layers() const {
  return shown_ && !is_lent() ? prepared_->layers.get() : nullptr;
}

bool LayerPreview::update() {
  const bool taken = take_result();
  return go_on() || taken;
}

bool LayerPreview::take_result() {
  if (!busy()) return false;
  std::optional<Result> result;
  try {
    result = job_.take();
  } catch (const Error& error) {
    failed_ = std::exchange(asked_, std::nullopt);
    message_ = error.what();
    prepared_.reset();
    shown_.reset();
    return true;
  }
  if (!result) return false;
  prepared_ = *std::move(result);
  shown_ = std::exchange(asked_, std::nullopt);
  is_exact_ = !changes_sizes_;
  message_.clear();
  return place();
}

// Starts the computation of the requested result. Returns true if it is available immediately.
bool LayerPreview::go_on() {
  if (!wanted_ || wanted_ == failed_) return false;
  const auto alike = [this](const std::optional<Wanted>& other) {
    return other && other->target == wanted_->target &&
           same_but_for_sliders(other->draft, wanted_->draft);
  };
  if (!is_lent() && alike(shown_)) return slide();
  if (!busy() || !alike(asked_)) prepare(*wanted_);
  return false;
}

// Updates the result for a request that can reuse `prepared_`. Returns true if it is available
// immediately.
bool LayerPreview::slide() {
  if (!same_sizes(shown_->draft, wanted_->draft)) {
    change_sizes(*wanted_);
    return false;
  }
  bool placed = false;
  if (wanted_ != shown_) {
    shown_ = wanted_;
    placed = place();
  }
  if (!is_exact_ && !busy()) prepare(*wanted_);
  return placed;
}

void LayerPreview::prepare(const Wanted& wanted) {
  // The worker may be changing `prepared_`, so it is no longer the result of a known request.
  if (is_lent()) shown_.reset();
  asked_ = wanted;
  changes_sizes_ = false;
  message_.clear();
  job_.start([wanted](const std::shared_ptr<Kernels>& kernels, const Progress& progress) {
    return prepared(wanted, kernels, progress);
  });
}

LayerPreview::Result LayerPreview::prepared(const Wanted& wanted,
                                            const std::shared_ptr<Kernels>& kernels,
                                            const Progress& progress) {
  step_of(wanted.draft);  // throws if something is missing
  auto result = std::make_shared<Prepared>(Prepared{kernels, wanted.target, wanted.draft, nullptr});
  report_progress(progress, "source", 0.0);
  result->layers = std::make_unique<LayeredCoat>(
      layered(result->draft), *result->target,
      read_source_meshes(result->draft.all_sources(), "", {}), *kernels, progress);
  return result;
}

// Changes the detail sizes of `prepared_` on the worker. Meanwhile only the worker may use it.
void LayerPreview::change_sizes(const Wanted& wanted) {
  asked_ = wanted;
  changes_sizes_ = true;
  job_.start([wanted, shown = *shown_, result = prepared_](const std::shared_ptr<Kernels>&,
                                                           const Progress& progress) {
    for (std::size_t k = 0; k < wanted.draft.source_count(); ++k) {
      const double size = wanted.draft.sources[k].detail_size;
      if (size != shown.draft.sources[k].detail_size) {
        result->layers->set_detail_size(k, size, progress);
      }
    }
    return result;
  });
}

bool LayerPreview::place() {
  try {
    positions_ = prepared_->layers->positions(amplitude_of(shown_->draft));
  } catch (const Error& error) {
    failed_ = shown_;
    message_ = error.what();
  }
  return true;
}

}  // namespace lapwing::viewer
