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

/// A picture for panels: ImGui::Image(picture.id(), ...). It must live at the same address until
/// the frame that shows it is drawn, on the same context, which must outlive it.
class UiPicture {
 public:
  UiPicture(gpu::Context& context, const Image& image);
  UiPicture(const UiPicture&) = delete;
  UiPicture& operator=(const UiPicture&) = delete;

  /// The ImTextureID for ImGui.
  void* id() const { return const_cast<UiPicture*>(this); }
  const gpu::Buffer& pixels() const { return pixels_; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }

 private:
  gpu::Buffer pixels_;
  std::uint32_t width_;
  std::uint32_t height_;
};

/// Draws ImGui's panels with its own pipelines. ImGui's Vulkan backend calls the Vulkan loader by
/// name, but this program opens the loader at run time. The context must outlive it.
class UiRenderer {
 public:
  /// `color` is the format of the picture, which has no depth.
  UiRenderer(gpu::Context& context, VkFormat color);

  /// Uploads the fonts of the current ImGui context. The device must have finished the last draw.
  void set_fonts();
  /// Copies one frame's panels to the device, which must have finished the last draw. Allocates
  /// only if there is more than ever before.
  void take(const ImDrawData& panels);
  /// Records the panels last taken into a rendering scope of size `extent`.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& panels) const;

 private:
  gpu::Context& context_;
  GraphicsPipeline texts_;  ///< and everything of one colour
  GraphicsPipeline pictures_;
  std::optional<gpu::Buffer> atlas_;
  std::uint32_t atlas_width_ = 0;
  std::uint32_t atlas_height_ = 0;
  gpu::Buffer corners_;
  gpu::Buffer vertices_;
};

}  // namespace lapwing::viewer
