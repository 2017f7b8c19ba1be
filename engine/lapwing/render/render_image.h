#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lapwing/io/image.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/offscreen.h"
#include "lapwing/render/renderer.h"

namespace lapwing {

struct RenderOptions {
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 960;  ///< in pixels
  std::uint32_t samples = 4;   ///< per pixel; reduced if the device supports fewer
  Background background = Background::gradient;
  SurfaceStyle style = {};
  bool legend = true;             ///< draws a legend if scalar values colour the surface
  std::optional<GroundGrid> grid = {};
  std::string legend_title = {};  ///< text above the legend: zero, one or several lines

  double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

/// Draws images without a display. Reuses the pipelines and render targets. On one device, the same
/// input gives a bitwise identical image. The context must outlive it.
class ImageRenderer {
 public:
  /// Throws GpuError if the device cannot draw or a size exceeds its limits.
  ImageRenderer(gpu::Context& context, const RenderOptions& options);

  /// Draws `surface` and `carried` at their current positions. All of them must be on the context
  /// of this object.
  Image render(Surface& surface, const SurfacePaint& paint, const Camera& camera,
               std::span<const CarriedDrawing> carried = {});

 private:
  gpu::Context& context_;
  RenderOptions options_;
  OffscreenTarget target_;
  Renderer renderer_;
};

/// Draws one image without a display, on the context of `surface`.
Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options = {}, std::span<const CarriedDrawing> carried = {});

}  // namespace lapwing
