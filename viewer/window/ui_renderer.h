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

/// An image for panels: ImGui::Image(picture.id(), ...). The object must exist until the frame that
/// shows it is drawn. This frame must use the same context, and the context must outlive it.
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

/// Draws ImGui's panels. It does not use ImGui's Vulkan backend, because this backend must be
/// linked with the Vulkan loader, which the program opens at run time. The context must outlive it.
class UiRenderer {
 public:
  /// `color` is the format of the target image, which has no depth buffer.
  UiRenderer(gpu::Context& context, VkFormat color);

  /// Uploads the fonts of the current ImGui context. The device must have finished the last draw.
  void set_fonts();
  /// Copies the panels of one frame to the device, which must have finished the last draw.
  /// Allocates memory only if the panels need more than in all previous frames.
  void take(const ImDrawData& panels);
  /// Records the panels of the last `take` into a rendering scope of size `extent`.
  void draw(VkCommandBuffer commands, VkExtent2D extent, const ImDrawData& panels) const;

 private:
  gpu::Context& context_;
  GraphicsPipeline texts_;  ///< draws text and shapes of one colour
  GraphicsPipeline pictures_;
  std::optional<gpu::Buffer> atlas_;
  std::uint32_t atlas_width_ = 0;
  std::uint32_t atlas_height_ = 0;
  gpu::Buffer corners_;
  gpu::Buffer vertices_;
};

}  // namespace lapwing::viewer
