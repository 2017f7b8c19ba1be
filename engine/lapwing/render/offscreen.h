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

/// Returns `width` x `height`. Throws GpuError if this size is zero or exceeds a limit of the
/// device, which the message names, or if the context's queue has no graphics support.
VkExtent2D checked_extent(const gpu::Context& context, std::uint32_t width, std::uint32_t height);

/// An offscreen render target with antialiasing. The context must outlive it.
class OffscreenTarget {
 public:
  /// Uses the largest supported number of samples per pixel up to `samples`. Throws GpuError as
  /// checked_extent does.
  OffscreenTarget(gpu::Context& context, std::uint32_t width, std::uint32_t height,
                  std::uint32_t samples = 4);

  const TargetFormat& format() const { return format_; }
  VkExtent2D extent() const { return extent_; }

  /// Runs the commands that `draw` records into a rendering scope and returns the pixels. With a
  /// transparent background, the colours are premultiplied by the opacity (see unpremultiply).
  Image render(const std::function<void(VkCommandBuffer commands)>& draw);

 private:
  VkExtent2D extent_;
  TargetFormat format_;
  DeviceImage color_;  ///< the image to read back
  DrawScope scope_;
  gpu::Buffer pixels_;
  gpu::CommandList commands_;
};

}  // namespace lapwing
