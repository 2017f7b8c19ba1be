#include "lapwing/gpu/kernel.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"

namespace lapwing::gpu {
namespace {

// Checks that the device can run a shader as a kernel. Returns how the shader accesses each buffer.
std::vector<BindingAccess> checked_bindings(const Context& context, const std::string& name,
                                            std::span<const std::uint32_t> spirv,
                                            std::uint32_t push_constant_bytes,
                                            std::uint32_t workgroup_size) {
  std::vector<BindingAccess> bindings = read_interface(spirv).bindings;
  // No kernel may update a buffer in place, because synchronization validation cannot see a missing
  // barrier between such dispatches.
  if (std::count(bindings.begin(), bindings.end(), BindingAccess::read_write) != 0) {
    throw GpuError("kernel " + name + ": declare every buffer of the shader readonly or writeonly");
  }
  const VkPhysicalDeviceLimits& limits = context.limits();
  if (workgroup_size == 0 || workgroup_size > limits.maxComputeWorkGroupInvocations ||
      workgroup_size > limits.maxComputeWorkGroupSize[0]) {
    throw GpuError("kernel " + name + ": " + context.description().name +
                   " does not support workgroups of " + std::to_string(workgroup_size) +
                   " invocations");
  }
  if (push_constant_bytes > limits.maxPushConstantsSize) {
    throw GpuError("kernel " + name + ": " + std::to_string(push_constant_bytes) +
                   " bytes of push constants exceed the " +
                   std::to_string(limits.maxPushConstantsSize) + " of " +
                   context.description().name);
  }
  return bindings;
}

Owned<VkPipeline> compute_pipeline(const Context& context, const std::string& name,
                                   std::span<const std::uint32_t> spirv, VkPipelineLayout layout,
                                   std::uint32_t workgroup_size) {
  const Owned<VkShaderModule> module = shader_module(context, spirv);
  const VkSpecializationMapEntry entry{0, 0, sizeof workgroup_size};
  const VkSpecializationInfo specialization{1, &entry, sizeof workgroup_size, &workgroup_size};
  VkComputePipelineCreateInfo info{VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO};
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout;
  const auto& vk = context.vk();
  VkPipeline pipeline = VK_NULL_HANDLE;
  context.check(
      vk.vkCreateComputePipelines(context.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline),
      ("vkCreateComputePipelines for kernel " + name).c_str());
  return {context, pipeline, vk.vkDestroyPipeline};
}

}  // namespace

Kernel::Kernel(const Context& context, std::string name, std::span<const std::uint32_t> spirv,
               std::uint32_t push_constant_bytes, std::uint32_t workgroup_size)
    : name_(std::move(name)),
      bindings_(checked_bindings(context, name_, spirv, push_constant_bytes, workgroup_size)),
      push_constant_bytes_(push_constant_bytes),
      workgroup_size_(workgroup_size),
      layout_(context, VK_SHADER_STAGE_COMPUTE_BIT, static_cast<std::uint32_t>(bindings_.size()),
              push_constant_bytes),
      pipeline_(compute_pipeline(context, name_, spirv, layout_.handle(), workgroup_size)) {}

}  // namespace lapwing::gpu
