#pragma once

#include <cstdint>
#include <optional>

#include "lapwing/gpu/buffer.h"
#include "lapwing/render/graphics_pipeline.h"

struct ImDrawData;

namespace lapwing {
struct Image;
}

namespace lapwing::viewer {

/// A picture that panels show: ImGui::Image(picture.id(), ...). It must live, and stay where it is,
/// until the frame that shows it is drawn, on the context that it was made on, which must outlive
/// it.
class UiPicture {
 public:
  UiPicture(gpu::Context& context, const Image& image);
  UiPicture(const UiPicture&) = delete;
  UiPicture& operator=(const UiPicture&) = delete;

  /// ImGui's ImTextureID of it.
  void* id() const { return const_cast<UiPicture*>(this); }
  const gpu::Buffer& pixels() const { return pixels_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  gpu::Buffer pixels_;
  std::uint32_t width_;
  std::uint32_t height_;
};

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
  GraphicsPipeline texts_;  ///< and all that has one colour
  GraphicsPipeline pictures_;
  std::optional<gpu::Buffer> atlas_;
  std::uint32_t atlas_width_ = 0;
  std::uint32_t atlas_height_ = 0;
  gpu::Buffer corners_;
  gpu::Buffer vertices_;
};

}  // namespace lapwing::viewer
