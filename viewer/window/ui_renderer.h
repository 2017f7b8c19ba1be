#pragma once

#include <cstdint>
#include <optional>

#include "lapwing/gpu/buffer.h"
#include "lapwing/render/graphics_pipeline.h"

struct ImDrawData;

namespace lapwing::viewer {

/// Draws what ImGui laid out, by the renderer's own pipelines: ImGui's Vulkan backend calls the
/// Vulkan loader by name, which this program opens at run time instead. The context must outlive
/// it.
class UiRenderer {
 public:
  /// For a picture of this format, without depth.
  UiRenderer(gpu::Context& context, VkFormat color);

  /// Takes over the fonts of the current ImGui context. The device must be done with the last draw.
  void set_fonts();
  /// Copies one frame's panels to the device. It must be done with the last draw. Allocates only
  /// when there is more than ever before.
  void take(const ImDrawData& panels);
  /// Records the panels last taken into a rendering scope of a picture of `extent`.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& panels) const;

 private:
  gpu::Context& context_;
  GraphicsPipeline pipeline_;
  std::optional<gpu::Buffer> atlas_;
  std::uint32_t atlas_width_ = 0;
  std::uint32_t atlas_height_ = 0;
  gpu::Buffer corners_;
  gpu::Buffer vertices_;
};

}  // namespace lapwing::viewer
