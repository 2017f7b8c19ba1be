#pragma once

#include <string>

#include <volk.h>

namespace lapwing {

namespace gpu {
class Context;
}

/// What a device image is made for.
struct DeviceImageInfo {
  std::string name;  ///< appears in error messages
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent2D extent{};
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkImageUsageFlags usage = 0;
  VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT;
  /// A second view reads and writes the same bits in this format, unless it is undefined or the
  /// image's own.
  VkFormat second_format = VK_FORMAT_UNDEFINED;
};

/// Layout, and the stages and accesses that a transition waits for or makes wait.
struct ImageState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 accesses = VK_ACCESS_2_NONE;
};

/// Records a barrier on the whole of an image with one level and layer. From an undefined layout
/// the contents are lost.
void transition_image(const gpu::Context& context, VkCommandBuffer commands, VkImage image,
                      VkImageAspectFlags aspect, const ImageState& from, const ImageState& to);

/// A two-dimensional image in device memory with one view or two of all of it. The context must
/// outlive it.
class DeviceImage {
 public:
  /// Throws GpuError, naming the image and the limit, when it cannot be had.
  DeviceImage(const gpu::Context& context, const DeviceImageInfo& info);
  ~DeviceImage();
  DeviceImage(DeviceImage&& other) noexcept;
  DeviceImage& operator=(DeviceImage&& other) noexcept;

  VkImage handle() const { return handle_; }
  VkImageView view() const { return view_; }
  /// The view in the second format, if there is one, else the first.
  VkImageView second_view() const { return second_view_ != VK_NULL_HANDLE ? second_view_ : view_; }
  /// As transition_image.
  void transition(VkCommandBuffer commands, const ImageState& from, const ImageState& to) const;

 private:
  void allocate(const std::string& name);
  void create_view(VkFormat format, VkImageView& view);
  void release() noexcept;

  const gpu::Context* context_;
  VkImageAspectFlags aspect_;
  VkImage handle_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  VkImageView second_view_ = VK_NULL_HANDLE;
};

}  // namespace lapwing
