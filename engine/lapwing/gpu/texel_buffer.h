#pragma once

#include <string>

#include <volk.h>

#include "lapwing/gpu/buffer.h"

namespace lapwing::gpu {

/// A buffer that kernels read as texels (`samplerBuffer`, `usamplerBuffer`). A software device
/// fetches a texel of four floats faster than it reads one float of a storage buffer; to a graphics
/// processor both are alike. Writers bind `buffer()`. The context must outlive it. Movable.
class TexelBuffer {
 public:
  enum class Format { vec4, uint };

  /// Throws GpuError when the device does not read so many texels.
  TexelBuffer(const Context& context, std::string name, Format format, VkDeviceSize texels);
  ~TexelBuffer();
  TexelBuffer(TexelBuffer&& other) noexcept;
  TexelBuffer& operator=(TexelBuffer&& other) noexcept;

  const Buffer& buffer() const { return buffer_; }
  VkBufferView view() const { return view_; }

 private:
  const Context* context_;
  Buffer buffer_;
  VkBufferView view_ = VK_NULL_HANDLE;
};

}  // namespace lapwing::gpu
