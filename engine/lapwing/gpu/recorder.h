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

/// Records dispatches and copies into a command list, and inserts barriers between them. It tracks
/// the reads and writes of every buffer; a command waits only for the accesses on which it depends.
/// The list begins with a barrier after all earlier submissions, and ends with a barrier that makes
/// its writes visible to the host. Lists therefore need no further synchronization.
class Recorder {
 public:
  /// Waits for the last submission of `list`, then clears the list.
  explicit Recorder(CommandList& list);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Records `invocations` invocations of `kernel`, rounded up to whole workgroups; the shader must
  /// ignore the surplus invocations (shaders/invocation.glsl). `buffers` are in the order of their
  /// bindings. If `invocations` is 0, records nothing. Throws GpuError, with the kernel's name, if
  /// the number of buffers or the size of `push` does not match the kernel, if a buffer exceeds
  /// limits().maxStorageBufferRange or is misaligned, or if a buffer is bound both for reading and
  /// for writing.
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
  /// Sets every 4 bytes of a buffer to `word`. Up to 3 bytes at the end do not change.
  void fill(const Buffer& buffer, std::uint32_t word);

  /// Declares how a command recorded through `handle()` accesses a buffer, and inserts the required
  /// barrier. Call this before the command and outside a rendering scope.
  void access(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses);
  /// Returns the command buffer, for commands that this class does not wrap.
  VkCommandBuffer handle() const { return list_.handle(); }

  /// Records a timestamp that is written when all earlier commands have finished. Returns its
  /// index.
  std::uint32_t timestamp();

  /// Completes the list. It cannot be submitted before this call.
  void finish();

  /// Returns the number of barriers inserted so far between commands of this list.
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
