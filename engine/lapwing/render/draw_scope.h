#pragma once

#include <cstdint>
#include <optional>

#include <volk.h>

#include "lapwing/gpu/recorder.h"
#include "lapwing/render/device_image.h"
#include "lapwing/render/graphics_pipeline.h"

namespace lapwing {

/// State of an image that is a render target.
inline constexpr ImageState kColorTarget{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
/// State of an image that is the source of a copy.
inline constexpr ImageState kCopySource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                        VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                        VK_ACCESS_2_TRANSFER_READ_BIT};
/// State of an image whose contents are discarded. A barrier from it waits for all earlier uses.
inline constexpr ImageState kDiscarded{VK_IMAGE_LAYOUT_UNDEFINED,
                                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_NONE};

/// Records a copy of `image` into `buffer` by rows from the top. The image must be in the state
/// kColorTarget.
void record_read_back(gpu::Recorder& recorder, const DeviceImage& image, VkExtent2D extent,
                      const gpu::Buffer& buffer);

/// Returns the largest number of samples per pixel, at most `wanted`, that the context's device
/// supports.
VkSampleCountFlagBits sample_count(const gpu::Context& context, std::uint32_t wanted);

/// Returns the format of antialiased images of `color`, an _SRGB format, with the largest supported
/// number of samples up to `samples`. On a software device, shaders encode the colours, which is
/// faster.
TargetFormat antialiased(const gpu::Context& context, VkFormat color, std::uint32_t samples);

/// A rendering scope that draws one image with depth, antialiased if the format has several
/// samples. Owns the depth and multisampled images, but not the target image, which belongs to a
/// window or an OffscreenTarget. The context must outlive it.
class DrawScope {
 public:
  DrawScope(const gpu::Context& context, VkExtent2D extent, const TargetFormat& format);

  /// Begins drawing into `picture`, an image with this scope's extent and colour format, one sample
  /// per pixel and the layout of kColorTarget. Clears it to transparent black, and the depth buffer
  /// to the farthest depth.
  void begin(VkCommandBuffer commands, VkImageView picture) const;
  /// Ends drawing into `picture`, the image passed to `begin`. Its layout does not change.
  void end(VkCommandBuffer commands, VkImageView picture) const;

 private:
  void begin(VkCommandBuffer commands, const VkRenderingAttachmentInfo& color,
             const VkRenderingAttachmentInfo* depth) const;

  const gpu::Context& context_;
  VkExtent2D extent_;
  bool shaders_encode_;
  DeviceImage depth_;
  std::optional<DeviceImage> multisampled_;  ///< the render target if there are several samples
};

}  // namespace lapwing
