#include "ui/turntable_recording.h"

#include <utility>

#include "lapwing/kernels/cpu_kernels.h"

namespace lapwing::viewer {

TurntableRecording::TurntableRecording(Order order, const Turntable& way, gpu::Context& context,
                                       const RenderOptions& options, std::function<void()> wake)
    : order_(std::move(order)),
      way_(way),
      renderer_(context, options),
      writer_(open_frames(order_.output,
                          {.count = order_.count,
                           .width = options.width,
                           .height = options.height,
                           .per_second = order_.per_second,
                           .transparent = options.background == Background::transparent})),
      job_([] { return std::make_unique<CpuKernels>(); }, std::move(wake)) {}

void TurntableRecording::take_written() {
  try {
    const std::optional<bool> was_last = job_.take();
    if (!was_last) return;
    is_writing_ = false;
    done_ = *was_last;
    if (!done_) ++written_;
  } catch (...) {
    failed_ = true;
    throw;
  }
}

void TurntableRecording::go_on(Surface& surface, const SurfacePaint& paint,
                               std::span<const CarriedDrawing> carried) {
  take_written();
  if (done_ || failed_) return;
  if (!waiting_ && drawn_ < order_.count) {
    waiting_ = std::make_shared<const Image>(
        renderer_.render(surface, paint, way_.camera(drawn_, order_.count), carried));
    ++drawn_;
  }
  if (std::exchange(is_writing_, true)) return;
  job_.start([this, image = std::exchange(waiting_, nullptr)](const std::shared_ptr<Kernels>&,
                                                              const Progress&) {
    image ? writer_->write(*image) : writer_->finish();
    return image == nullptr;
  });
}

}  // namespace lapwing::viewer
