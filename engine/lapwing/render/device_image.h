#pragma once

#include <string>

#include "lapwing/gpu/owned.h"

namespace lapwing {

struct DeviceImageInfo {
  std::string name;  ///< appears in error messages
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent{};
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkImageUsageFlags usage = 0;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  /// Format of a second view of the same bits. If it is undefined or equal to `format`, there is no
  /// second view.
  VkFormat second_format = VK_FORMAT_UNDEFINED;
};

/// Layout of an image, and the pipeline stages and memory accesses that a barrier synchronizes.
struct ImageState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 accesses = VK_ACCESS_2_NONE;
};

/// Records a barrier on a whole image with one level and layer. If `from` has an undefined layout,
/// the contents are discarded.
void transition_image(const gpu::Context& context, VkCommandBuffer commands, VkImage image,
                      VkImageAspectFlags aspect, const ImageState& from, const ImageState& to);

/// A two-dimensional image in device memory with one or two views of the whole image. The context
/// must outlive it.
class DeviceImage {
 public:
  /// If the image cannot be created, throws GpuError, which names the image and the limit.
  DeviceImage(const gpu::Context& context, const DeviceImageInfo& info);

  const gpu::Context& context() const { return *context_; }
  VkImage handle() const { return handle_.get(); }
  VkImageView view() const { return view_.get(); }
  /// Returns the view in the second format if there is one, otherwise `view()`.
  VkImageView second_view() const {
    return second_view_.get() != VK_NULL_HANDLE ? second_view_.get() : view_.get();
  }
  /// Records a barrier as transition_image does.
  void transition(VkCommandBuffer commands, const ImageState& from, const ImageState& to) const;

 private:
  void allocate(const std::string& name);
  gpu::Owned<VkImageView> create_view(VkFormat format) const;

  const gpu::Context* context_;
  VkImageAspectFlags aspect_;
  /// Declared first, so that it outlives the image and the views.
  gpu::Owned<VkDeviceMemory> memory_;
  gpu::Owned<VkImage> handle_;
  gpu::Owned<VkImageView> view_;
  gpu::Owned<VkImageView> second_view_;
};

}  // namespace lapwing
