#include "lapwing/gpu/buffer.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/results.h"
#include "lapwing/gpu/structure.h"

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

// Uncached memory (a discrete GPU's, seen over the bus) is very slow to read: staging is better.
constexpr VkMemoryPropertyFlags kUnified = kMappable | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;

}  // namespace

Buffer::Buffer(const Context& context, std::string name, VkDeviceSize bytes, Memory memory)
    : context_(&context), name_(std::move(name)), bytes_(bytes) {
  context.check_allocation_size(bytes, "the buffer \"" + name_ + "\"");
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = std::max(bytes, kSmallestBuffer);
  info.usage = kUsage;
  info.sharingMode = VK_SHARING_MODE_EXCLUSIVE;
  context.check(context.vk().vkCreateBuffer(context.device(), &info, nullptr, &handle_),
                "vkCreateBuffer");
  try {
    allocate(memory);
  } catch (...) {
    release();
    throw;
  }
}

void Buffer::allocate(Memory memory) {
  const auto& vk = context_->vk();
  VkMemoryRequirements needs;
  vk.vkGetBufferMemoryRequirements(context_->device(), handle_, &needs);
  std::uint32_t type = 0;
  switch (memory) {
    case Memory::device:
      type = context_->memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                   kUnified);
      break;
    case Memory::upload:
      type = context_->memory_type(needs.memoryTypeBits, kMappable,
                                   VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
      break;
    case Memory::readback:
      type = context_->memory_type(needs.memoryTypeBits, kMappable,
                                   VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
      break;
  }
  auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = needs.size;
  info.memoryTypeIndex = type;
  const VkResult result = vk.vkAllocateMemory(context_->device(), &info, nullptr, &memory_);
  if (result < VK_SUCCESS) {
    throw GpuError("no memory for the buffer \"" + name_ + "\" of " + std::to_string(bytes_) +
                   " bytes on " + context_->description().name + ": " + result_name(result) +
                   "; choose a smaller region, or run with --device cpu");
  }
  context_->check(vk.vkBindBufferMemory(context_->device(), handle_, memory_, 0),
                  "vkBindBufferMemory");
  const VkMemoryPropertyFlags flags = context_->memory_flags(type);
  const bool unified = context_->maps_device_memory() && (flags & kUnified) == kUnified;
  if (memory == Memory::device && !unified) return;
  void* address = nullptr;
  context_->check(vk.vkMapMemory(context_->device(), memory_, 0, VK_WHOLE_SIZE, 0, &address),
                  "vkMapMemory");
  mapped_ = static_cast<std::byte*>(address);
}

void Buffer::release() noexcept {
  const auto& vk = context_->vk();
  if (handle_ != VK_NULL_HANDLE) vk.vkDestroyBuffer(context_->device(), handle_, nullptr);
  if (memory_ != VK_NULL_HANDLE) vk.vkFreeMemory(context_->device(), memory_, nullptr);
}

Buffer::~Buffer() {
  release();
}

Buffer::Buffer(Buffer&& other) noexcept
    : context_(other.context_),
      name_(std::move(other.name_)),
      bytes_(std::exchange(other.bytes_, 0)),
      handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
      memory_(std::exchange(other.memory_, VK_NULL_HANDLE)),
      mapped_(std::exchange(other.mapped_, nullptr)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(name_, other.name_);
  std::swap(bytes_, other.bytes_);
  std::swap(handle_, other.handle_);
  std::swap(memory_, other.memory_);
  std::swap(mapped_, other.mapped_);
  return *this;
}

}  // namespace lapwing::gpu
