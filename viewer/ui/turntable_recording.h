#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "lapwing/render/frame_writer.h"
#include "lapwing/render/render_image.h"
#include "lapwing/render/turntable.h"
#include "work/worker.h"

namespace lapwing::viewer {

/// A turntable that is being saved: its pictures are drawn between the window's frames, and written
/// beside the window. When it goes before it is done, numbered pictures stay as far as they are
/// written, and of a video nothing.
class TurntableRecording {
 public:
  struct Order {
    std::filesystem::path output;  ///< open_frames'
    int count = 1;                 ///< of the pictures
    double per_second = 30.0;
  };

  /// Throws what open_frames and ImageRenderer do. The context must outlive it. `wake` is called
  /// beside the window when there is news.
  TurntableRecording(Order order, const Turntable& way, gpu::Context& context,
                     const RenderOptions& options, std::function<void()> wake);
  ~TurntableRecording();

  /// Once a frame: draws the next picture, unless one waits to be written. Throws, once, what
  /// writing threw.
  void go_on(Surface& surface, const SurfacePaint& paint, std::span<const CarriedDrawing> carried);

  const Order& order() const { return order_; }
  int written() const;
  bool is_done() const;

 private:
  Worker::Work next();
  void carry_out(const std::function<void()>& work);

  Order order_;
  Turntable way_;
  ImageRenderer renderer_;
  std::unique_ptr<FrameWriter> writer_;  // the worker's
  int drawn_ = 0;

  // Guarded by the worker's mutex.
  std::optional<Image> waiting_;
  int written_ = 0;
  bool finishes_ = false;
  bool done_ = false;
  bool given_up_ = false;
  std::exception_ptr error_;

  Worker worker_;  // last: it uses all the others
};

}  // namespace lapwing::viewer
