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

/// A picture's size. Throws GpuError, naming the limit, for one that is empty or larger than the
/// device's largest, and when the context's queue has no graphics.
VkExtent2D checked_extent(const gpu::Context& context, std::uint32_t width, std::uint32_t height);

/// A picture to draw into that is not on a screen, with antialiasing. The context must outlive it.
class OffscreenTarget {
 public:
  /// `samples` per pixel are wanted; as many as the device has are taken, up to that. Throws
  /// GpuError, naming the limit, for a picture that is empty or larger than the device's largest,
  /// and when the context's queue has no graphics.
  OffscreenTarget(gpu::Context& context, std::uint32_t width, std::uint32_t height,
                  std::uint32_t samples = 4);

  const TargetFormat& format() const { return format_; }
  VkExtent2D extent() const { return extent_; }

  /// Runs what `draw` records into a rendering scope and returns the pixels. At edges what was
  /// drawn is averaged with what lies behind; where that is transparent, colours come out
  /// multiplied by their opacity (see divide_by_opacity).
  Image render(const std::function<void(VkCommandBuffer commands)>& draw);

 private:
  gpu::Context& context_;
  VkExtent2D extent_;
  TargetFormat format_;
  DeviceImage color_;  ///< what is read back
  DrawScope scope_;
  gpu::Buffer pixels_;
  gpu::CommandList commands_;
};

}  // namespace lapwing
