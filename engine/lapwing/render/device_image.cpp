#include "lapwing/render/device_image.h"

#include "lapwing/gpu/context.h"

namespace lapwing {

DeviceImage::DeviceImage(const gpu::Context& context, const DeviceImageInfo& info)
    : context_(&context), aspect_(info.aspect) {
  VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  create.imageType = VK_IMAGE_TYPE_2D;
  create.format = info.format;
  create.extent = {info.extent.width, info.extent.height, 1};
  create.mipLevels = 1;
  create.arrayLayers = 1;
  create.samples = info.samples;
  create.tiling = VK_IMAGE_TILING_OPTIMAL;
  create.usage = info.usage;
  const bool has_second =
      info.second_format != VK_FORMAT_UNDEFINED && info.second_format != info.format;
  if (has_second) create.flags = VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
  const auto& vk = context.vk();
  handle_ = gpu::create(context, vk.vkCreateImage, vk.vkDestroyImage, create, "vkCreateImage");
  allocate(info.name);
  view_ = create_view(info.format);
  if (has_second) second_view_ = create_view(info.second_format);
}

void DeviceImage::allocate(const std::string& name) {
  const auto& vk = context_->vk();
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(context_->device(), handle(), &needs);
  context_->check_allocation_size(needs.size, "the image \"" + name + "\"");
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  info.memoryTypeIndex =
      context_->memory_type(needs.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  memory_ = gpu::create(*context_, vk.vkAllocateMemory, vk.vkFreeMemory, info,
                        ("vkAllocateMemory for the image \"" + name + "\"").c_str());
  context_->check(vk.vkBindImageMemory(context_->device(), handle(), memory_.get(), 0),
                  "vkBindImageMemory");
}

gpu::Owned<VkImageView> DeviceImage::create_view(VkFormat format) const {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = handle();
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {aspect_, 0, 1, 0, 1};
  const auto& vk = context_->vk();
  return gpu::create(*context_, vk.vkCreateImageView, vk.vkDestroyImageView, info,
                     "vkCreateImageView");
}

void DeviceImage::transition(VkCommandBuffer commands, const ImageState& from,
                             const ImageState& to) const {
  transition_image(*context_, commands, handle(), aspect_, from, to);
}

void transition_image(const gpu::Context& context, VkCommandBuffer commands, VkImage image,
                      VkImageAspectFlags aspect, const ImageState& from, const ImageState& to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.accesses;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.accesses;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  context.vk().vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace lapwing
