#include "lapwing/gpu/command_list.h"

#include <exception>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"

namespace lapwing::gpu {
namespace {

// Enough for 63 dispatches, far more than in any list.
constexpr std::uint32_t kProfileQueries = 128;
constexpr double kMillisecondsPerNanosecond = 1e-6;

}  // namespace

CommandList::CommandList(Context& context, std::string name, std::uint32_t timestamps)
    : context_(context),
      name_(std::move(name)),
      timestamp_capacity_(context.limits().timestampComputeAndGraphics != VK_FALSE ? timestamps
                                                                                   : 0) {
  if (context.profile() != nullptr && context.limits().timestampComputeAndGraphics != VK_FALSE) {
    profile_capacity_ = kProfileQueries;
  }
  const auto& vk = context.vk();
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = context.queue_family();
  pool_ =
      create(context, vk.vkCreateCommandPool, vk.vkDestroyCommandPool, pool, "vkCreateCommandPool");
  VkCommandBufferAllocateInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  buffer.commandPool = pool_.get();
  buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  buffer.commandBufferCount = 1;
  context.check(vk.vkAllocateCommandBuffers(context.device(), &buffer, &handle_),
                "vkAllocateCommandBuffers");
  if (timestamp_capacity_ + profile_capacity_ == 0) return;
  VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = timestamp_capacity_ + profile_capacity_;
  queries_ =
      create(context, vk.vkCreateQueryPool, vk.vkDestroyQueryPool, queries, "vkCreateQueryPool");
}

CommandList::~CommandList() {
  try {
    wait();
  } catch (const std::exception&) {
    // If the device is lost, there is nothing to wait for.
  }
}

std::uint64_t CommandList::submit(std::span<const VkSemaphoreSubmitInfo> waits,
                                  std::span<const VkSemaphoreSubmitInfo> signals) {
  if (!recorded_) {
    throw GpuError("command list \"" + name_ + "\" was submitted before it was recorded");
  }
  wait();
  last_submission_ = context_.submit(handle_, waits, signals);
  in_profile_ = context_.profile() == nullptr;
  return last_submission_;
}

void CommandList::wait() const {
  context_.wait(last_submission_);
  if (!in_profile_) add_to_profile();
}

std::uint64_t CommandList::ticks_at(std::uint32_t query) const {
  std::uint64_t ticks = 0;
  context_.check(context_.vk().vkGetQueryPoolResults(
                     context_.device(), queries_.get(), query, 1, sizeof ticks, &ticks,
                     sizeof ticks, VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
                 "vkGetQueryPoolResults");
  return ticks;
}

double CommandList::milliseconds_between(std::uint32_t first, std::uint32_t second) const {
  if (queries_.get() == VK_NULL_HANDLE) return 0.0;
  return static_cast<double>(ticks_at(second) - ticks_at(first)) *
         context_.limits().timestampPeriod * kMillisecondsPerNanosecond;
}

void CommandList::add_to_profile() const {
  in_profile_ = true;
  DeviceUse use;
  use.submissions = 1;
  use.device_ms = milliseconds_between(timestamp_capacity_, timestamp_capacity_ + 1);
  std::uint32_t query = timestamp_capacity_ + 2;
  for (const std::string& kernel : profiled_kernels_) {
    KernelUse& own = use.kernels[kernel];
    ++own.dispatches;
    if (query + 1 < timestamp_capacity_ + profile_capacity_) {
      own.device_ms += milliseconds_between(query, query + 1);
    }
    query += 2;
  }
  context_.profile()->add(use);
}

}  // namespace lapwing::gpu
