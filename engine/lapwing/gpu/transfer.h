#pragma once

#include <cstddef>
#include <memory>
#include <ranges>
#include <span>

#include "lapwing/gpu/buffer.h"

namespace lapwing::gpu {

class Context;
class CommandList;

/// Copies numbers between host memory and buffers: directly if the buffer is mapped, else piece by
/// piece through a mapped staging buffer, which is created when first needed. Calls return when the
/// copy is done. The device must have finished with the buffer. Not thread-safe.
class Transfer {
 public:
  explicit Transfer(Context& context);
  ~Transfer();

  /// Copies `data` to `offset` bytes into `buffer`. Throws GpuError if it does not fit.
  void upload(const Buffer& buffer, std::span<const std::byte> data, VkDeviceSize offset = 0);
  template <std::ranges::contiguous_range Range>
  void upload(const Buffer& buffer, const Range& data, VkDeviceSize offset = 0) {
    upload(buffer, std::span<const std::byte>(std::as_bytes(std::span(data))), offset);
  }

  /// Fills `data` from `offset` bytes into `buffer`. Throws GpuError if that exceeds the buffer.
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
