#include "lapwing/gpu/buffer.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/results.h"

namespace lapwing::gpu {
namespace {

// Vulkan has no empty buffers.
constexpr VkDeviceSize kSmallestBuffer = 16;

constexpr VkBufferUsageFlags kUsage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
    VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;

constexpr VkMemoryPropertyFlags kMappable =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

// Uncached memory, such as that of a discrete GPU accessed over the bus, is very slow to read.
// Staging is faster.
constexpr VkMemoryPropertyFlags kUnified = kMappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

}  // namespace

Buffer::Buffer(const Context& context, std::string name, VkDeviceSize bytes, Memory memory)
    : name_(std::move(name)), bytes_(bytes) {
  context.check_allocation_size(bytes, "the buffer \"" + name_ + "\"");
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = std::max(bytes, kSmallestBuffer);
  info.usage = kUsage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  const auto& vk = context.vk();
  handle_ = create(context, vk.vkCreateBuffer, vk.vkDestroyBuffer, info, "vkCreateBuffer");
  allocate(context, memory);
}

void Buffer::allocate(const Context& context, Memory memory) {
  const auto& vk = context.vk();
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(context.device(), handle(), &needs);
  std::uint32_t type = 0;
  switch (memory) {
    case Memory::device:
      type =
          context.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, kUnified);
      break;
    case Memory::upload:
      type =
          context.memory_type(needs.memoryTypeBits, kMappable, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
      break;
    case Memory::readback:
      type =
          context.memory_type(needs.memoryTypeBits, kMappable, VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
      break;
  }
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type;
  VkDeviceMemory allocated = VK_NULL_HANDLE;
  const VkResult result = vk.vkAllocateMemory(context.device(), &info, nullptr, &allocated);
  if (result < VK_SUCCESS) {
    throw GpuError("no memory for the buffer \"" + name_ + "\" of " + std::to_string(bytes_) +
                   " bytes on " + context.description().name + ": " + result_name(result) +
                   "; choose a smaller region, or run with --device cpu");
  }
  memory_ = {context, allocated, vk.vkFreeMemory};
  context.check(vk.vkBindBufferMemory(context.device(), handle(), allocated, 0),
                "vkBindBufferMemory");
  const VkMemoryPropertyFlags flags = context.memory_flags(type);
  const bool unified = context.maps_device_memory() && (flags & kUnified) == kUnified;
  if (memory == Memory::device && !unified) return;
  void* address = nullptr;
  context.check(vk.vkMapMemory(context.device(), allocated, 0, VK_WHOLE_SIZE, 0, &address),
                "vkMapMemory");
  mapped_ = static_cast<std::byte*>(address);
}

}  // namespace lapwing::gpu
