#include "lapwing/gpu/texel_buffer.h"

#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/structure.h"

namespace lapwing::gpu {
namespace {

struct FormatInfo {
  VkFormat format;
  VkDeviceSize bytes;
};

// Every Vulkan device reads these two from buffers.
FormatInfo info_of(TexelBuffer::Format format) {
  return format == TexelBuffer::Format::vec4
             ? FormatInfo{VK_FORMAT_R32G32B32A32_SFLOAT, 4 * sizeof(float)}
             : FormatInfo{VK_FORMAT_R32_UINT, sizeof(std::uint32_t)};
}

}  // namespace

TexelBuffer::TexelBuffer(const Context& context, std::string name, Format format,
                         VkDeviceSize texels)
    : context_(&context), buffer_(context, std::move(name), texels * info_of(format).bytes) {
  if (texels > context.limits().maxTexelBufferElements) {
    throw GpuError("the buffer \"" + buffer_.name() + "\" has " + std::to_string(texels) +
                   " texels, but " + context.description().name + " reads at most " +
                   std::to_string(context.limits().maxTexelBufferElements) +
                   "; take a smaller mesh, or run with --device cpu");
  }
  auto info = structure<VkBufferViewCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO);
  info.buffer = buffer_.handle();
  info.format = info_of(format).format;
  info.range = VK_WHOLE_SIZE;
  context.check(context.vk().vkCreateBufferView(context.device(), &info, nullptr, &view_),
                "vkCreateBufferView");
}

TexelBuffer::~TexelBuffer() {
  if (view_ != VK_NULL_HANDLE) {
    context_->vk().vkDestroyBufferView(context_->device(), view_, nullptr);
  }
}

TexelBuffer::TexelBuffer(TexelBuffer&& other) noexcept
    : context_(other.context_),
      buffer_(std::move(other.buffer_)),
      view_(std::exchange(other.view_, VK_NULL_HANDLE)) {}

TexelBuffer& TexelBuffer::operator=(TexelBuffer&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(buffer_, other.buffer_);
  std::swap(view_, other.view_);
  return *this;
}

}  // namespace lapwing::gpu
