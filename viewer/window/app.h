#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "lapwing/render/camera.h"
#include "lapwing/render/renderer.h"
#include "preferences/preferences.h"
#include "tools/input.h"

namespace lapwing {
class SurfacePaint;
class Surface;
namespace gpu {
class Context;
}
}  // namespace lapwing

namespace lapwing::viewer {

/// A surface with its camera and style.
struct SurfaceScene {
  Surface* surface = nullptr;
  const SurfacePaint* paint = nullptr;  ///< of the surface
  Camera camera;
  SurfaceStyle style;
};

/// Another surface, in its own part of the picture.
struct SideScene : SurfaceScene {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< upper left, in whole pixels
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    ///< in whole pixels; inside the picture
};

/// What a frame shows under the panels: only the background if there is no surface.
struct Scene : SurfaceScene {
  std::span<const CarriedDrawing> carried;  ///< drawn with the surface
  std::optional<SideScene> beside;
  Background background = Background::gradient;
  /// Whether something moves. Then the scene is drawn quickly, without antialiasing.
  bool moving = false;
};

/// Times of the parts of a frame in milliseconds. Times on the device are 0 if it has no timestamps
/// or had nothing to do.
struct FrameTimings {
  double blend_ms = 0.0;    ///< the positions of a drag, on the device
  double normals_ms = 0.0;  ///< their normals, on the device
  double draw_ms = 0.0;     ///< the surface, on the device
  double ui_ms = 0.0;       ///< the panels, on the device
  double panels_ms = 0.0;   ///< the layout of the panels, on the CPU
  double frame_ms = 0.0;    ///< from the first event to the presentation of the image
};

/// The interface that the main loop calls, always on one thread.
class App {
 public:
  virtual ~App() = default;

  /// Handles an event over the picture; events for the panels do not come here. Returns whether the
  /// picture may have changed.
  virtual bool handle(const InputEvent& event) = 0;
  /// Opens a file that was dropped on the window.
  virtual void open(const std::filesystem::path& file) = 0;
  /// Sets the size of the picture in pixels, never 0, and the pixels per point (Projection),
  /// positive. Called before the first frame and whenever they change.
  virtual void resize(const Eigen::Vector2d& size, double pixels_per_point) = 0;
  /// Calls ImGui for the panels of one frame. `last` is of the previous frame. Any exception but a
  /// GpuError ends the main loop.
  virtual void draw_ui(const FrameTimings& last) = 0;
  /// Returns the scene under the panels. What it refers to must live until the next call.
  virtual Scene scene() = 0;
  /// Returns the title of the window; valid until the next call.
  virtual std::string_view title() const = 0;
  /// Returns the theme of the panels from the next frame on.
  virtual Theme theme() const { return Theme::dark; }
  /// The user wants to close the window. `wants_to_quit` tells when it may close.
  virtual void ask_to_close() = 0;
  virtual bool wants_to_quit() const = 0;

  /// Replaces a lost device by `context`. The app must recreate its resources from host memory and
  /// release the old device. May follow any call that threw a GpuError.
  virtual void use_device(std::shared_ptr<gpu::Context> context) = 0;
};

}  // namespace lapwing::viewer
