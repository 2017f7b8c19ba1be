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

/// A surface and how it is looked at.
struct SurfaceScene {
  Surface* surface = nullptr;
  const SurfacePaint* paint = nullptr;  ///< of the surface
  Camera camera;
  SurfaceStyle style;
};

/// Another surface, in a part of the picture that shows nothing else.
struct SideScene : SurfaceScene {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< the upper left one, in whole pixels
  Eigen::Vector2d size = Eigen::Vector2d::Ones();    ///< likewise; all of it in the picture
};

/// What a frame shows under the panels. Without a surface only the background.
struct Scene : SurfaceScene {
  std::span<const CarriedDrawing> carried;  ///< drawn with the surface
  std::optional<SideScene> beside;
  Background background = Background::gradient;
  /// Whether it is being moved: then it is drawn quickly, without antialiasing.
  bool moving = false;
};

/// How long the parts of a frame took, in milliseconds. Those on the device are 0 where it has no
/// timestamps, and where there was nothing to do.
struct FrameTimings {
  double blend_ms = 0.0;    ///< the positions of a drag, on the device
  double normals_ms = 0.0;  ///< their normals, on the device
  double draw_ms = 0.0;     ///< the surface, on the device
  double ui_ms = 0.0;       ///< the panels, on the device
  double panels_ms = 0.0;   ///< laying the panels out, on the processor
  double frame_ms = 0.0;    ///< from the first event to the picture handed to the screen
};

/// What the main loop calls, all on one thread.
class App {
 public:
  virtual ~App() = default;

  /// What a person did over the picture; what the panels take does not come here. True if the
  /// picture may have changed.
  virtual bool handle(const InputEvent& event) = 0;
  /// A file dropped on the window.
  virtual void open(const std::filesystem::path& file) = 0;
  /// The pixels of the picture, never 0, and of a point (Projection's), above 0; before the first
  /// frame and whenever they change.
  virtual void resize(const Eigen::Vector2d& size, double pixels_per_point) = 0;
  /// Calls ImGui for the panels of one frame. `last` is of the frame before. What this throws ends
  /// the main loop, but for gpu::DeviceLost.
  virtual void draw_ui(const FrameTimings& last) = 0;
  /// What to draw under them; must live until the next call.
  virtual Scene scene() = 0;
  /// What the window is called. Until the next call.
  virtual std::string_view title() const = 0;
  /// How the panels look from the next frame on.
  virtual Theme theme() const { return Theme::dark; }
  /// The person wants the window closed; `wants_to_quit` says when it may be.
  virtual void ask_to_close() = 0;
  virtual bool wants_to_quit() const = 0;

  /// The device was lost and `context` takes its place: whatever the app made on the old one is to
  /// be made anew, from what the host has, and the old one let go. May follow on any other call
  /// that threw gpu::DeviceLost.
  virtual void use_device(std::shared_ptr<gpu::Context> context) = 0;
};

}  // namespace lapwing::viewer
