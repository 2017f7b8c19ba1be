#pragma once

#include <cstdint>
#include <functional>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/io/image.h"
#include "lapwing/render/device_image.h"
#include "lapwing/render/draw_scope.h"
#include "lapwing/render/graphics_pipeline.h"

namespace lapwing {

/// Returns the size of a picture. Throws GpuError, naming the limit, if it is empty or too large
/// for the device, or if the context's queue has no graphics.
VkExtent2D checked_extent(const gpu::Context& context, std::uint32_t width, std::uint32_t height);

/// An offscreen picture to draw into, with antialiasing. The context must outlive it.
class OffscreenTarget {
 public:
  /// Uses as many samples per pixel as the device has, up to `samples`. Throws GpuError as
  /// checked_extent does.
  OffscreenTarget(gpu::Context& context, std::uint32_t width, std::uint32_t height,
                  std::uint32_t samples = 4);

  const TargetFormat& format() const { return format_; }
  VkExtent2D extent() const { return extent_; }

  /// Runs the commands that `draw` records into a rendering scope and returns the pixels. Edges are
  /// averaged with what lies behind. Over a transparent background, their colours are multiplied by
  /// their opacity (see unpremultiply).
  Image render(const std::function<void(VkCommandBuffer commands)>& draw);

 private:
  VkExtent2D extent_;
  TargetFormat format_;
  DeviceImage color_;  ///< the picture to read back
  DrawScope scope_;
  gpu::Buffer pixels_;
  gpu::CommandList commands_;
};

}  // namespace lapwing
