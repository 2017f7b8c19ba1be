#include "ui/turntable_recording.h"

#include <utility>

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
      worker_([this] { return next(); }, std::move(wake)) {}

TurntableRecording::~TurntableRecording() {
  const std::lock_guard lock(worker_.mutex());
  given_up_ = true;
}

void TurntableRecording::go_on(Surface& surface, const SurfacePaint& paint,
                               std::span<const CarriedDrawing> carried) {
  {
    const std::lock_guard lock(worker_.mutex());
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
    if (waiting_ || drawn_ == order_.count) return;
  }
  Image image = renderer_.render(surface, paint, way_.camera(drawn_, order_.count), carried);
  ++drawn_;
  {
    const std::lock_guard lock(worker_.mutex());
    waiting_ = std::move(image);
  }
  worker_.notify();
}

int TurntableRecording::written() const {
  const std::lock_guard lock(worker_.mutex());
  return written_;
}

bool TurntableRecording::is_done() const {
  const std::lock_guard lock(worker_.mutex());
  return done_;
}

Worker::Work TurntableRecording::next() {
  if (given_up_) return {};
  if (waiting_) {
    return [this, image = *std::exchange(waiting_, std::nullopt)] {
      carry_out([&] { writer_->write(image); });
    };
  }
  if (written_ < order_.count || std::exchange(finishes_, true)) return {};
  return [this] { carry_out([this] { writer_->finish(); }); };
}

void TurntableRecording::carry_out(const std::function<void()>& work) {
  std::exception_ptr error;
  try {
    work();
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(worker_.mutex());
  if (error) {
    error_ = error;
    given_up_ = true;
  } else if (finishes_) {
    done_ = true;
  } else {
    ++written_;
  }
}

}  // namespace lapwing::viewer
