#pragma once

#include <cstdint>
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
  std::uint32_t samples = 4;   ///< per pixel, as far as the device has them
  Background background = Background::gradient;
  SurfaceStyle style = {};
  bool legend = true;             ///< draws a legend if numbers colour the surface
  std::string legend_title = {};  ///< text above the legend; may be empty or have several lines

  double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

/// Draws images without a display, one after the other, and reuses the pipelines and render targets
/// for them. On one device, the same input gives a bitwise identical image. The context must
/// outlive it.
class ImageRenderer {
 public:
  /// Throws GpuError if the device cannot draw or a size exceeds its limits.
  ImageRenderer(gpu::Context& context, const RenderOptions& options);

  /// Draws the current buffers of `surface` and the drawings carried along with it, all on the
  /// context.
  Image render(Surface& surface, const SurfacePaint& paint, const Camera& camera,
               std::span<const CarriedDrawing> carried = {});

 private:
  gpu::Context& context_;
  RenderOptions options_;
  OffscreenTarget target_;
  Renderer renderer_;
};

/// Draws one such image on the context of `surface`.
Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options = {}, std::span<const CarriedDrawing> carried = {});

}  // namespace lapwing
