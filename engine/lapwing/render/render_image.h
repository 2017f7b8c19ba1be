#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "lapwing/io/image.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/renderer.h"

namespace lapwing {

struct RenderOptions {
  std::uint32_t width = 1280;  ///< in pixels
  std::uint32_t height = 960;  ///< in pixels
  std::uint32_t samples = 4;   ///< per pixel, where the device has them
  Background background = Background::gradient;
  SurfaceStyle style;
  bool legend = true;        ///< beside a surface coloured by numbers
  std::string legend_title;  ///< above the legend, in lines; may be empty

  double aspect() const { return static_cast<double>(width) / static_cast<double>(height); }
};

/// A picture of `surface` as its buffers are now, and of what is carried along with it, without a
/// display. Makes pipelines and images for the one picture: for many, keep an OffscreenTarget and a
/// Renderer. Same input, same bits on one device. Throws GpuError for a device that cannot draw and
/// for sizes beyond its limits.
Image render_image(Surface& surface, const SurfacePaint& paint, const Camera& camera,
                   const RenderOptions& options = {}, std::span<const CarriedDrawing> carried = {});

}  // namespace lapwing
