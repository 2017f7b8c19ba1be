#include "lapwing/gpu/recorder.h"

#include <algorithm>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"

namespace lapwing::gpu {
namespace {

constexpr VkAccessFlags2 kAllWrites =
    VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
    VK_ACCESS_2_SHADER_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_HOST_WRITE_BIT;

void barrier(const Context& context, VkCommandBuffer commands, const VkMemoryBarrier2& memory) {
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &memory;
  context.vk().vkCmdPipelineBarrier2(commands, &info);
}

VkAccessFlags2 shader_access(BindingAccess access) {
  switch (access) {
    case BindingAccess::read:
      return VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    case BindingAccess::write:
      return VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
    case BindingAccess::read_write:
      return VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
  }
  return 0;
}

[[noreturn]] void throw_dispatch_error(const Kernel& kernel, const std::string& what) {
  throw GpuError("dispatch of kernel " + kernel.name() + ": " + what);
}

}  // namespace

Recorder::Recorder(CommandList& list) : list_(list) {
  const Context& context = list.context();
  const auto& vk = context.vk();
  list.wait();
  list.recorded_ = false;
  list.histories_.clear();
  context.check(vk.vkResetCommandPool(context.device(), list.pool_.get(), 0), "vkResetCommandPool");
  const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  context.check(vk.vkBeginCommandBuffer(list.handle(), &begin), "vkBeginCommandBuffer");
  if (list.queries_.get() != VK_NULL_HANDLE) {
    vk.vkCmdResetQueryPool(list.handle(), list.queries_.get(), 0,
                           list.timestamp_capacity_ + list.profile_capacity_);
  }
  list.profiled_kernels_.clear();
  write_profile_timestamp(0);
  VkMemoryBarrier2 earlier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  earlier.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  earlier.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  earlier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  earlier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier(context, list.handle(), earlier);
}

void Recorder::finish() {
  write_profile_timestamp(1);
  const Context& context = list_.context();
  VkMemoryBarrier2 host{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  host.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  host.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
  host.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  host.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  barrier(context, list_.handle(), host);
  context.check(context.vk().vkEndCommandBuffer(list_.handle()), "vkEndCommandBuffer");
  list_.recorded_ = true;
}

Recorder::History& Recorder::history_of(VkBuffer buffer) {
  auto& histories = list_.histories_;
  const auto found = std::find_if(histories.begin(), histories.end(),
                                  [&](const History& h) { return h.buffer == buffer; });
  if (found != histories.end()) return *found;
  return histories.emplace_back(History{buffer, {}, {}, 0});
}

void Recorder::require(VkBuffer buffer, const Scope& next) {
  History& history = history_of(buffer);
  const auto wait_for = [&](const Scope& earlier) {
    pending_.srcStageMask |= earlier.stages;
    pending_.srcAccessMask |= earlier.accesses;
    pending_.dstStageMask |= next.stages;
    pending_.dstAccessMask |= next.accesses;
  };
  if ((next.accesses & kAllWrites) != 0) {
    if (history.write.stages != 0) wait_for(history.write);
    // A write after reads only waits for their execution; reads leave no data to make visible.
    if (history.read_stages != 0) wait_for({history.read_stages, 0});
    history.write = next;
    history.visible = {};
    history.read_stages = 0;
    return;
  }
  const bool seen = (next.stages & ~history.visible.stages) == 0 &&
                    (next.accesses & ~history.visible.accesses) == 0;
  if (history.write.stages != 0 && !seen) {
    wait_for(history.write);
    history.visible.stages |= next.stages;
    history.visible.accesses |= next.accesses;
  }
  history.read_stages |= next.stages;
}

void Recorder::place_pending_barrier() {
  if (pending_.srcStageMask == 0) return;
  pending_.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
  barrier(list_.context(), list_.handle(), pending_);
  pending_ = {};
  ++barrier_count_;
}

void Recorder::access(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 accesses) {
  require(buffer.handle(), {stages, accesses});
  place_pending_barrier();
}

void Recorder::check_dispatch(const Kernel& kernel, std::span<const BufferRange> buffers,
                              std::span<const std::byte> push) const {
  const auto bindings = kernel.bindings();
  const VkPhysicalDeviceLimits& limits = list_.context().limits();
  if (buffers.size() != bindings.size()) {
    throw_dispatch_error(kernel, "it takes " + std::to_string(bindings.size()) + " buffers, not " +
                                     std::to_string(buffers.size()));
  }
  if (push.size() != kernel.push_constant_bytes()) {
    throw_dispatch_error(kernel, "it takes " + std::to_string(kernel.push_constant_bytes()) +
                                     " bytes of push constants, not " +
                                     std::to_string(push.size()));
  }
  for (std::size_t b = 0; b < buffers.size(); ++b) {
    const auto name = [&] { return "the buffer \"" + buffers[b].buffer->name() + "\""; };
    if (buffers[b].bytes > limits.maxStorageBufferRange) {
      throw_dispatch_error(kernel, name() + " is bound with " + std::to_string(buffers[b].bytes) +
                                       " bytes, beyond the device's limit of " +
                                       std::to_string(limits.maxStorageBufferRange));
    }
    if (buffers[b].offset % limits.minStorageBufferOffsetAlignment != 0) {
      throw_dispatch_error(kernel, name() + " is bound at an offset that is not a multiple of " +
                                       std::to_string(limits.minStorageBufferOffsetAlignment));
    }
    for (std::size_t other = 0; other < b; ++other) {
      const bool one_writes =
          (bindings[other] == BindingAccess::write) != (bindings[b] == BindingAccess::write);
      if (buffers[other].buffer == buffers[b].buffer && one_writes) {
        throw_dispatch_error(kernel, name() + " is bound both for reading and for writing");
      }
    }
  }
}

void Recorder::dispatch(const Kernel& kernel, std::uint64_t invocations,
                        std::span<const BufferRange> buffers, std::span<const std::byte> push) {
  check_dispatch(kernel, buffers, push);
  if (invocations == 0) return;
  for (std::size_t b = 0; b < buffers.size(); ++b) {
    require(buffers[b].buffer->handle(),
            {VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, shader_access(kernel.bindings()[b])});
  }
  place_pending_barrier();
  kernel.layout().bind(handle(), VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline(), buffers, push);
  const std::uint64_t groups =
      (invocations + kernel.workgroup_size() - 1) / kernel.workgroup_size();
  const std::uint64_t row =
      std::min<std::uint64_t>(groups, list_.context().limits().maxComputeWorkGroupCount[0]);
  const std::uint64_t rows = (groups + row - 1) / row;
  if (rows > list_.context().limits().maxComputeWorkGroupCount[1]) {
    throw_dispatch_error(kernel,
                         std::to_string(invocations) + " invocations exceed the device's limit");
  }
  const auto query = static_cast<std::uint32_t>(2 + 2 * list_.profiled_kernels_.size());
  write_profile_timestamp(query);
  list_.context().vk().vkCmdDispatch(handle(), static_cast<std::uint32_t>(row),
                                     static_cast<std::uint32_t>(rows), 1);
  write_profile_timestamp(query + 1);
  if (list_.context().profile() != nullptr) list_.profiled_kernels_.push_back(kernel.name());
}

void Recorder::copy(const BufferRange& source, const BufferRange& target) {
  if (source.bytes != target.bytes) {
    throw GpuError("copy from \"" + source.buffer->name() + "\" to \"" + target.buffer->name() +
                   "\": the ranges differ in length");
  }
  if (source.bytes == 0) return;
  constexpr VkPipelineStageFlags2 kStage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT;
  require(source.buffer->handle(), {kStage, VK_ACCESS_2_TRANSFER_READ_BIT});
  require(target.buffer->handle(), {kStage, VK_ACCESS_2_TRANSFER_WRITE_BIT});
  place_pending_barrier();
  const VkBufferCopy region{source.offset, target.offset, source.bytes};
  list_.context().vk().vkCmdCopyBuffer(handle(), source.buffer->handle(), target.buffer->handle(),
                                       1, &region);
}

void Recorder::fill(const Buffer& buffer, std::uint32_t word) {
  if (buffer.bytes() < sizeof word) return;
  require(buffer.handle(), {VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT});
  place_pending_barrier();
  list_.context().vk().vkCmdFillBuffer(handle(), buffer.handle(), 0,
                                       buffer.bytes() / sizeof word * sizeof word, word);
}

// For every stage, software devices write a timestamp without waiting for earlier commands; they
// only wait at barriers. After a draw, they also delay the timestamp to the next barrier, that is,
// until after all kernels before that barrier.
void Recorder::write_timestamp(std::uint32_t query) {
  VkMemoryBarrier2 everything{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  everything.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  everything.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier(list_.context(), handle(), everything);
  list_.context().vk().vkCmdWriteTimestamp2(handle(), VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                            list_.queries_.get(), query);
  if (list_.context().description().type == "software") {
    barrier(list_.context(), handle(), everything);
  }
}

void Recorder::write_profile_timestamp(std::uint32_t number) {
  if (number < list_.profile_capacity_) write_timestamp(list_.timestamp_capacity_ + number);
}

std::uint32_t Recorder::timestamp() {
  if (list_.timestamp_capacity_ == 0) return timestamp_count_++;
  if (timestamp_count_ >= list_.timestamp_capacity_) {
    throw GpuError("command list \"" + list_.name() + "\" holds only " +
                   std::to_string(list_.timestamp_capacity_) + " timestamps");
  }
  write_timestamp(timestamp_count_);
  return timestamp_count_++;
}

}  // namespace lapwing::gpu
