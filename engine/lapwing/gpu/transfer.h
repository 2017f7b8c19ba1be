#pragma once

#include <cstddef>
#include <memory>
#include <ranges>
#include <span>

#include "lapwing/gpu/buffer.h"

namespace lapwing::gpu {

class Context;
class CommandList;

/// Copies numbers between host memory and buffers. If the buffer is mapped, copies directly.
/// Otherwise, copies piece by piece through a mapped staging buffer, which is created when it is
/// first needed. Calls return when the copy is complete. The device must not use the buffer during
/// a call. Not thread-safe.
class Transfer {
 public:
  explicit Transfer(Context& context);
  ~Transfer();

  /// Copies `data` to `buffer`, starting at byte `offset`. Throws GpuError if the data do not fit.
  void upload(const Buffer& buffer, std::span<const std::byte> data, VkDeviceSize offset = 0);
  template <std::ranges::contiguous_range Range>
  void upload(const Buffer& buffer, const Range& data, VkDeviceSize offset = 0) {
    upload(buffer, std::span<const std::byte>(std::as_bytes(std::span(data))), offset);
  }

  /// Copies from `buffer`, starting at byte `offset`, to `data`. Throws GpuError if this range
  /// exceeds the buffer.
  void download(const Buffer& buffer, std::span<std::byte> data, VkDeviceSize offset = 0);
  template <std::ranges::contiguous_range Range>
  void download(const Buffer& buffer, Range&& data, VkDeviceSize offset = 0) {
    download(buffer, std::span<std::byte>(std::as_writable_bytes(std::span(data))), offset);
  }

 private:
  struct Staging;
  Staging& staging();

  Context& context_;
  std::unique_ptr<Staging> staging_;
};

}  // namespace lapwing::gpu
