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

/// Saves a turntable: draws its pictures between the window's frames, and writes them on another
/// thread. If it is destroyed early, the numbered pictures written so far stay, but no video.
class TurntableRecording {
 public:
  struct Order {
    std::filesystem::path output;  ///< for open_frames
    int count = 1;                 ///< number of pictures
    double per_second = 30.0;
  };

  /// `wake` is called on another thread when there is progress. The context must outlive this.
  /// Throws what open_frames and ImageRenderer throw.
  TurntableRecording(Order order, const Turntable& way, gpu::Context& context,
                     const RenderOptions& options, std::function<void()> wake);
  ~TurntableRecording();

  /// Call this once a frame. Draws the next picture, unless one waits to be written. Throws, once,
  /// what writing threw.
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
  std::unique_ptr<FrameWriter> writer_;  // used by the worker
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
