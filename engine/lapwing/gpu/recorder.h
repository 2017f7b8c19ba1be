#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <type_traits>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/kernel.h"

namespace lapwing::gpu {

/// Records dispatches and copies into a command list and places the barriers between them. It
/// tracks every buffer's reads and writes, and a command waits only for those that it depends on.
/// The list begins with a barrier against all earlier submissions and ends with one that makes its
/// writes visible to the host, so lists need no further synchronization.
class Recorder {
 public:
  /// Clears `list` after its last submission has finished.
  explicit Recorder(CommandList& list);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Runs `kernel` for at least `invocations` invocations, rounded up to whole workgroups; the
  /// shader ignores the surplus (shaders/invocation.glsl). `buffers` are in the order of their
  /// bindings. Throws GpuError, naming the kernel, if their number is not the kernel's, if one
  /// exceeds limits().maxStorageBufferRange or is misaligned, if one is bound both for reading and
  /// for writing, or if `push` does not have the kernel's size. 0 invocations record nothing.
  void dispatch(const Kernel& kernel, std::uint64_t invocations,
                std::span<const BufferRange> buffers, std::span<const std::byte> push);
  void dispatch(const Kernel& kernel, std::uint64_t invocations,
                std::initializer_list<BufferRange> buffers) {
    dispatch(kernel, invocations, {buffers.begin(), buffers.size()}, {});
  }
  template <typename Push>
  void dispatch(const Kernel& kernel, std::uint64_t invocations,
                std::initializer_list<BufferRange> buffers, const Push& push) {
    static_assert(std::is_trivially_copyable_v<Push>);
    dispatch(kernel, invocations, {buffers.begin(), buffers.size()},
             std::as_bytes(std::span(&push, 1)));
  }

  /// Copies `source` to `target`, which must have the same length.
  void copy(const BufferRange& source, const BufferRange& target);
  /// Sets every 4 bytes of a buffer to `word`. Up to 3 bytes at the end stay.
  void fill(const Buffer& buffer, std::uint32_t word);

  /// Declares how a command recorded through `handle()` will access a buffer, and places the
  /// barrier that it needs. Call it before the command, and outside a rendering scope.
  void access(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses);
  /// For commands that this class does not wrap.
  VkCommandBuffer handle() const { return list_.handle(); }

  /// Writes a timestamp after all commands before it have finished. Returns its number, from 0.
  std::uint32_t timestamp();

  /// Makes the list ready to submit. Without this call it cannot be submitted.
  void finish();

  /// Returns the number of barriers placed so far between commands of this list.
  std::size_t barrier_count() const { return barrier_count_; }

 private:
  using Scope = CommandList::Scope;
  using History = CommandList::History;

  History& history_of(VkBuffer buffer);
  void require(VkBuffer buffer, const Scope& next);
  void place_pending_barrier();
  void check_dispatch(const Kernel& kernel, std::span<const BufferRange> buffers,
                      std::span<const std::byte> push) const;
  void write_timestamp(std::uint32_t query);
  void write_profile_timestamp(std::uint32_t number);

  CommandList& list_;
  VkMemoryBarrier2 pending_{};
  std::size_t barrier_count_ = 0;
  std::uint32_t timestamp_count_ = 0;
};

}  // namespace lapwing::gpu
