#include "lapwing/render/device_image.h"

#include <utility>

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
  try {
    context.check(context.vk().vkCreateImage(context.device(), &create, nullptr, &handle_),
                  "vkCreateImage");
    allocate(info.name);
    create_view(info.format, view_);
    if (has_second) create_view(info.second_format, second_view_);
  } catch (...) {
    release();
    throw;
  }
}

void DeviceImage::allocate(const std::string& name) {
  const auto& vk = context_->vk();
  VkMemoryRequirements needs;
  vk.vkGetImageMemoryRequirements(context_->device(), handle_, &needs);
  context_->check_allocation_size(needs.size, "the image \"" + name + "\"");
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  info.memoryTypeIndex =
      context_->memory_type(needs.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  context_->check(vk.vkAllocateMemory(context_->device(), &info, nullptr, &memory_),
                  ("vkAllocateMemory for the image \"" + name + "\"").c_str());
  context_->check(vk.vkBindImageMemory(context_->device(), handle_, memory_, 0),
                  "vkBindImageMemory");
}

void DeviceImage::create_view(VkFormat format, VkImageView& view) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = handle_;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = format;
  info.subresourceRange = {aspect_, 0, 1, 0, 1};
  context_->check(context_->vk().vkCreateImageView(context_->device(), &info, nullptr, &view),
                  "vkCreateImageView");
}

void DeviceImage::transition(VkCommandBuffer commands, const ImageState& from,
                             const ImageState& to) const {
  transition_image(*context_, commands, handle_, aspect_, from, to);
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

void DeviceImage::release() noexcept {
  const auto& vk = context_->vk();
  const VkDevice device = context_->device();
  for (const VkImageView view : {view_, second_view_}) {
    if (view != VK_NULL_HANDLE) vk.vkDestroyImageView(device, view, nullptr);
  }
  if (handle_ != VK_NULL_HANDLE) vk.vkDestroyImage(device, handle_, nullptr);
  if (memory_ != VK_NULL_HANDLE) vk.vkFreeMemory(device, memory_, nullptr);
}

DeviceImage::~DeviceImage() {
  release();
}

DeviceImage::DeviceImage(DeviceImage&& other) noexcept
    : context_(other.context_),
      aspect_(other.aspect_),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      view_(std::exchange(other.view_, VK_NULL_HANDLE)),
      second_view_(std::exchange(other.second_view_, VK_NULL_HANDLE)) {}

DeviceImage& DeviceImage::operator=(DeviceImage&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(aspect_, other.aspect_);
  std::swap(handle_, other.handle_);
  std::swap(memory_, other.memory_);
  std::swap(view_, other.view_);
  std::swap(second_view_, other.second_view_);
  return *this;
}

}  // namespace lapwing
