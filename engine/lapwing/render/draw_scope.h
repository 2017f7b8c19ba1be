#pragma once

#include <cstdint>
#include <optional>

#include <volk.h>

#include "lapwing/render/device_image.h"
#include "lapwing/render/graphics_pipeline.h"

namespace lapwing {

/// How an image is used while it is drawn into.
inline constexpr ImageState kColorTarget{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
/// How it is used while it is copied from.
inline constexpr ImageState kCopySource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                        VK_ACCESS_2_TRANSFER_READ_BIT};
/// What an image held is of no use. Waits for whoever used it before.
inline constexpr ImageState kDiscarded{VK_IMAGE_LAYOUT_UNDEFINED,
                                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};

/// As many samples per pixel, up to `wanted`, as the context's device draws with.
VkSampleCountFlagBits sample_count(const gpu::Context& context, std::uint32_t wanted);

/// A target for pictures of `color`, an _SRGB format, with sample_count samples, in the way that
/// the context's device draws soonest.
TargetFormat antialiased(const gpu::Context& context, VkFormat color, std::uint32_t samples);

/// A rendering scope that draws one picture with depth, antialiased where the format has several
/// samples. Holds the images that this takes beside the picture itself, which is someone else's: a
/// window's or an OffscreenTarget's. The context must outlive it.
class DrawScope {
 public:
  DrawScope(const gpu::Context& context, VkExtent2D extent, const TargetFormat& format);

  /// Begins drawing into `picture`, an image of the extent and colour format, with one sample, in
  /// the layout of kColorTarget. It starts transparent black; depth starts farthest.
  void begin(VkCommandBuffer commands, VkImageView picture) const;
  /// The same picture is whole once this is done, in the same layout.
  void end(VkCommandBuffer commands, VkImageView picture) const;

 private:
  void begin(VkCommandBuffer commands, const VkRenderingAttachmentInfo& color,
             const VkRenderingAttachmentInfo* depth) const;

  const gpu::Context& context_;
  VkExtent2D extent_;
  bool shaders_encode_;
  DeviceImage depth_;
  std::optional<DeviceImage> multisampled_;  ///< drawn into, with more than one sample
};

}  // namespace lapwing
