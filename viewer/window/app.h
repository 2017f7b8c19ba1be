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
  const SurfacePaint* paint = nullptr;  ///< colours of the surface
  Camera camera;
  SurfaceStyle style;
};

/// A second surface, which is drawn in a rectangle of the scene's image.
struct SideScene : SurfaceScene {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< upper left corner, in whole pixels
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    ///< size, in whole pixels; inside the image
};

/// A second surface, which is drawn in the left part of the scene's image instead of the first one.
struct LeftScene {
  Surface* surface = nullptr;
  const SurfacePaint* paint = nullptr;
  SurfaceStyle style;
  double width = 0.0;  ///< of the left part, in pixels
};

/// The contents of a frame under the panels. Without a surface, only the background is drawn.
struct Scene : SurfaceScene {
  std::span<const CarriedDrawing> carried;  ///< drawn with the surface
  std::optional<GroundGrid> grid;           ///< under the surface
  std::optional<LeftScene> left;
  std::optional<SideScene> beside;
  Background background = Background::gradient;
  /// Whether something moves. If so, and if a frame with antialiasing takes too long, the scene is
  /// drawn without it.
  bool moving = false;
};

/// Times of the parts of a frame in milliseconds. Times on the device are 0 if the device has no
/// timestamps or nothing was computed.
struct FrameTimings {
  double blend_ms = 0.0;    ///< computing the positions of a drag, on the device
  double normals_ms = 0.0;  ///< computing the normals of a drag, on the device
  double draw_ms = 0.0;     ///< drawing the scene, on the device
  double ui_ms = 0.0;       ///< drawing the panels, on the device
  double panels_ms = 0.0;   ///< layout of the panels, on the CPU
  double frame_ms = 0.0;    ///< from the first event to the presentation of the image
};

/// The interface that the main loop calls, always on one thread.
class App {
 public:
  virtual ~App() = default;

  /// Handles an event for the view; events for the panels are not passed to the app. Returns
  /// whether the scene may have changed.
  virtual bool handle(const InputEvent& event) = 0;
  /// Opens a file that was dropped on the window.
  virtual void open(const std::filesystem::path& file) = 0;
  /// Sets the size of the view in pixels, never 0, and the number of pixels per point (Projection),
  /// always positive. Called before the first frame and whenever the size changes.
  virtual void resize(const Eigen::Vector2d& size, double pixels_per_point) = 0;
  /// Calls ImGui for the panels of one frame. `last` contains the times of the previous frame. Any
  /// exception except a GpuError ends the main loop.
  virtual void draw_ui(const FrameTimings& last) = 0;
  /// Returns the scene under the panels. Its pointers must remain valid until the next call.
  virtual Scene scene() = 0;
  /// Returns the title of the window. The text must remain valid until the next call.
  virtual std::string_view title() const = 0;
  /// Returns the theme of the panels for the next frames.
  virtual Theme theme() const { return Theme::dark; }
  /// Called when the user closes the window. The app may first ask for confirmation; the main loop
  /// ends when `wants_to_quit` returns true.
  virtual void ask_to_close() = 0;
  virtual bool wants_to_quit() const = 0;

  /// Replaces a lost device by `context`. The app must recreate its resources from host memory and
  /// release the old device. Called after another function has thrown a GpuError.
  virtual void use_device(std::shared_ptr<gpu::Context> context) = 0;
};

}  // namespace lapwing::viewer
