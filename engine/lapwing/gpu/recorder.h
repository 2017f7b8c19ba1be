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

/// Records dispatches and copies into a command list and places the barriers between them itself:
/// it follows every buffer's reads and writes, and a command waits for just those it depends on.
/// The list begins with a barrier against all earlier submissions and ends with one that makes its
/// writes visible to the host, so lists can follow one another without further care.
class Recorder {
 public:
  /// Starts over: what `list` held is dropped, once its last submission is done.
  explicit Recorder(CommandList& list);
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Runs `kernel` for at least `invocations` invocations, rounded up to whole workgroups; the
  /// shader ignores the surplus (shaders/invocation.glsl). `buffers` by binding. Throws GpuError,
  /// naming the kernel, when their number is not the kernel's, one exceeds
  /// limits().maxStorageBufferRange or is misaligned, one is bound both to be read and written, or
  /// `push` is not of the kernel's size. 0 invocations record nothing.
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

  /// Copies `source` to the start of `target`'s range; both of the same length.
  void copy(const BufferRange& source, const BufferRange& target);
  /// Sets every 4 bytes of a buffer to `word`; the last bytes of an odd length stay.
  void fill(const Buffer& buffer, std::uint32_t word);

  /// Declares what a command recorded through `handle()` is about to do with a buffer, and places
  /// the barrier that it needs. Call it before the command, and outside a rendering scope.
  void access(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses);
  /// For commands that this class does not wrap.
  VkCommandBuffer handle() const { return list_.handle(); }

  /// Writes a timestamp once all commands before it are done; its number, from 0.
  std::uint32_t timestamp();

  /// Makes the list ready to submit. A recorder that is dropped before leaves it empty.
  void finish();

  /// Barriers placed so far between commands of this list.
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
  void bind(const Kernel& kernel, std::span<const BufferRange> buffers,
            std::span<const std::byte> push);

  CommandList& list_;
  VkMemoryBarrier2 pending_{};
  std::size_t barrier_count_ = 0;
  std::uint32_t timestamp_count_ = 0;
};

}  // namespace lapwing::gpu
