#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lapwing/gpu/owned.h"

namespace lapwing::gpu {

/// Who accesses a buffer's memory.
enum class Memory {
  device,    ///< the device; also mapped if the memory is unified
  upload,    ///< written by the host, read by the device; always mapped
  readback,  ///< written by the device, read by the host; always mapped
};

/// Device memory for numbers, usable as storage, uniform, vertex and index buffer and in copies.
/// Each buffer has its own allocation. The engine holds tens of buffers, far below any device's
/// limit (4096), and frees them whole, so sharing blocks would save nothing. Contents are undefined
/// at first. The context must outlive it. Movable.
class Buffer {
 public:
  /// `name` appears in error messages. A buffer of 0 bytes can be bound but holds nothing. Throws
  /// GpuError, naming the bytes and the limit, if the memory cannot be allocated.
  Buffer(const Context& context, std::string name, VkDeviceSize bytes,
         Memory memory = Memory::device);

  VkBuffer handle() const { return handle_.get(); }
  VkDeviceSize bytes() const { return bytes_; }
  const std::string& name() const { return name_; }

  /// Returns the memory mapped to the host (coherent), or an empty span if it is not mapped (see
  /// Memory). Wait for the device before you read what it wrote or overwrite what it reads.
  std::span<std::byte> mapped() const { return {mapped_, mapped_ == nullptr ? 0 : bytes_}; }
  template <typename T>
  std::span<T> mapped_as() const {
    return {reinterpret_cast<T*>(mapped_), mapped().size() / sizeof(T)};
  }

 private:
  void allocate(const Context& context, Memory memory);

  std::string name_;
  VkDeviceSize bytes_;
  Owned<VkDeviceMemory> memory_;  ///< declared before the buffer, so it is freed last
  Owned<VkBuffer> handle_;
  std::byte* mapped_ = nullptr;
};

/// A part of a buffer, as bound to a kernel. A Buffer converts to the range of all of it. Offsets
/// must be multiples of limits().minStorageBufferOffsetAlignment.
struct BufferRange {
  BufferRange(const Buffer& whole)  // NOLINT(google-explicit-constructor): that is its purpose
      : buffer(&whole), bytes(whole.bytes()) {}
  BufferRange(const Buffer& part_of, VkDeviceSize from, VkDeviceSize length)
      : buffer(&part_of), offset(from), bytes(length) {}

  const Buffer* buffer;
  VkDeviceSize offset = 0;
  VkDeviceSize bytes;
};

}  // namespace lapwing::gpu
