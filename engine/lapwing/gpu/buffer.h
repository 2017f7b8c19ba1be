#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lapwing/gpu/owned.h"

namespace lapwing::gpu {

/// How host and device access a buffer's memory.
enum class Memory {
  device,    ///< read and written by the device; also mapped if the memory is unified
  upload,    ///< written by the host, read by the device; always mapped
  readback,  ///< written by the device, read by the host; always mapped
};

/// Device memory for numbers, usable as a storage, uniform, vertex or index buffer and in copies.
/// Each buffer has its own allocation: the engine uses some tens of buffers, far below the limit of
/// 4096 on any device. The initial contents are undefined. The context must outlive the buffer.
/// Movable.
class Buffer {
 public:
  /// `name` appears in error messages. A buffer of 0 bytes can be bound but contains no data.
  /// Throws GpuError if the memory cannot be allocated; the message gives the size and the limit.
  Buffer(const Context& context, std::string name, VkDeviceSize bytes,
         Memory memory = Memory::device);

  VkBuffer handle() const { return handle_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  const std::string& name() const { return name_; }

  /// Returns the host-mapped (coherent) memory, or an empty span if it is not mapped (see Memory).
  /// Wait for the device before you read its results or overwrite its inputs.
  std::span<std::byte> mapped() const { return {mapped_, mapped_ == nullptr ? 0 : bytes_}; }
  template <typename T>
  std::span<T> mapped_as() const {
    return {reinterpret_cast<T*>(mapped_), mapped().size() / sizeof(T)};
  }

 private:
  void allocate(const Context& context, Memory memory);

  std::string name_;
  VkDeviceSize bytes_;
  Owned<VkDeviceMemory> memory_;  ///< declared before the buffer, so it is freed after the buffer
  Owned<VkBuffer> handle_;
  std::byte* mapped_ = nullptr;
};

/// A range of a buffer that is bound to a kernel. A Buffer converts to its whole range. Offsets
/// must be multiples of limits().minStorageBufferOffsetAlignment.
struct BufferRange {
  BufferRange(const Buffer& whole)  // NOLINT(google-explicit-constructor): intended conversion
      : buffer(&whole), bytes(whole.bytes()) {}
  BufferRange(const Buffer& part_of, VkDeviceSize from, VkDeviceSize length)
      : buffer(&part_of), offset(from), bytes(length) {}

  const Buffer* buffer;
  VkDeviceSize offset = 0;
  VkDeviceSize bytes;
};

}  // namespace lapwing::gpu
