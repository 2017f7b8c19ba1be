#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "lapwing/render/frame_writer.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"
#include "work/job.h"

namespace lapwing::viewer {

/// Saves a turntable. Renders its images between the window's frames and writes them on another
/// thread. If it is destroyed before the end, the numbered images written so far remain. A video is
/// then not saved.
class TurntableRecording {
 public:
  struct Order {
    std::filesystem::path output;  ///< for open_frames
    int count = 1;                 ///< number of images
    double per_second = 30.0;
  };

  /// `wake` is called on another thread when there is progress. The context must outlive this.
  /// Throws what open_frames and ImageRenderer throw.
  TurntableRecording(Order order, const Turntable& way, gpu::Context& context,
                     const RenderOptions& options, std::function<void()> wake);

  /// Call this once per frame. Renders the next image, unless the previous one waits to be written.
  /// If writing has failed, rethrows the exception once.
  void go_on(Surface& surface, const SurfacePaint& paint, std::span<const CarriedDrawing> carried);

  const Order& order() const { return order_; }
  int written() const { return written_; }
  bool is_done() const { return done_; }

 private:
  void take_written();

  Order order_;
  Turntable way_;
  ImageRenderer renderer_;
  std::unique_ptr<FrameWriter> writer_;  // used by `job_`
  int drawn_ = 0;
  std::shared_ptr<const Image> waiting_;  // a rendered frame that is not yet passed to `job_`
  int written_ = 0;
  bool is_writing_ = false;
  bool done_ = false;
  bool failed_ = false;
  Job<bool> job_;  // returns whether the video is finished; declared last, as it uses `writer_`
};

}  // namespace lapwing::viewer
