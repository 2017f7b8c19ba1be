#include "lapwing/gpu/kernel.h"

#include <algorithm>
#include <utility>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/structure.h"

namespace lapwing::gpu {

Kernel::Kernel(const Context& context, std::string name, std::span<const std::uint32_t> spirv,
               std::uint32_t push_constant_bytes, std::uint32_t workgroup_size)
    : context_(&context),
      name_(std::move(name)),
      bindings_(read_interface(spirv).bindings),
      push_constant_bytes_(push_constant_bytes),
      workgroup_size_(workgroup_size) {
  // No kernel may update a buffer in place, because synchronization validation cannot see a missing
  // barrier between such dispatches.
  if (std::count(bindings_.begin(), bindings_.end(), BindingAccess::read_write) != 0) {
    throw GpuError("kernel " + name_ +
                   ": declare every buffer of the shader readonly or writeonly");
  }
  const VkPhysicalDeviceLimits& limits = context.limits();
  if (workgroup_size == 0 || workgroup_size > limits.maxComputeWorkGroupInvocations ||
      workgroup_size > limits.maxComputeWorkGroupSize[0]) {
    throw GpuError("kernel " + name_ + ": " + context.description().name +
                   " does not support workgroups of " + std::to_string(workgroup_size) +
                   " invocations");
  }
  if (push_constant_bytes > limits.maxPushConstantsSize) {
    throw GpuError("kernel " + name_ + ": " + std::to_string(push_constant_bytes) +
                   " bytes of push constants exceed the " +
                   std::to_string(limits.maxPushConstantsSize) + " of " +
                   context.description().name);
  }
  try {
    create_layout();
    create_pipeline(spirv);
  } catch (...) {
    release();
    throw;
  }
}

void Kernel::create_layout() {
  std::vector<VkDescriptorSetLayoutBinding> layout_bindings(bindings_.size());
  for (std::uint32_t b = 0; b < layout_bindings.size(); ++b) {
    layout_bindings[b].binding = b;
    layout_bindings[b].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    layout_bindings[b].descriptorCount = 1;
    layout_bindings[b].stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
  }
  auto set = structure<VkDescriptorSetLayoutCreateInfo>(
      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = static_cast<std::uint32_t>(layout_bindings.size());
  set.pBindings = layout_bindings.data();
  const auto& vk = context_->vk();
  context_->check(vk.vkCreateDescriptorSetLayout(context_->device(), &set, nullptr, &set_layout_),
                  "vkCreateDescriptorSetLayout");

  const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_constant_bytes_};
  auto layout =
      structure<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout_;
  layout.pushConstantRangeCount = push_constant_bytes_ == 0 ? 0 : 1;
  layout.pPushConstantRanges = &push;
  context_->check(vk.vkCreatePipelineLayout(context_->device(), &layout, nullptr, &layout_),
                  "vkCreatePipelineLayout");
}

void Kernel::create_pipeline(std::span<const std::uint32_t> spirv) {
  const auto& vk = context_->vk();
  auto code = structure<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
  code.codeSize = spirv.size_bytes();
  code.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  context_->check(vk.vkCreateShaderModule(context_->device(), &code, nullptr, &module),
                  "vkCreateShaderModule");

  const VkSpecializationMapEntry entry{0, 0, sizeof workgroup_size_};
  const VkSpecializationInfo specialization{1, &entry, sizeof workgroup_size_, &workgroup_size_};
  auto info =
      structure<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout_;
  const VkResult result = vk.vkCreateComputePipelines(context_->device(), VK_NULL_HANDLE, 1, &info,
                                                      nullptr, &pipeline_);
  vk.vkDestroyShaderModule(context_->device(), module, nullptr);
  context_->check(result, ("vkCreateComputePipelines for kernel " + name_).c_str());
}

void Kernel::release() noexcept {
  const auto& vk = context_->vk();
  const VkDevice device = context_->device();
  if (pipeline_ != VK_NULL_HANDLE) vk.vkDestroyPipeline(device, pipeline_, nullptr);
  if (layout_ != VK_NULL_HANDLE) vk.vkDestroyPipelineLayout(device, layout_, nullptr);
  if (set_layout_ != VK_NULL_HANDLE) {
    vk.vkDestroyDescriptorSetLayout(device, set_layout_, nullptr);
  }
}

Kernel::~Kernel() {
  release();
}

Kernel::Kernel(Kernel&& other) noexcept
    : context_(other.context_),
      name_(std::move(other.name_)),
      bindings_(std::move(other.bindings_)),
      push_constant_bytes_(other.push_constant_bytes_),
      workgroup_size_(other.workgroup_size_),
      set_layout_(std::exchange(other.set_layout_, VK_NULL_HANDLE)),
      layout_(std::exchange(other.layout_, VK_NULL_HANDLE)),
      pipeline_(std::exchange(other.pipeline_, VK_NULL_HANDLE)) {}

Kernel& Kernel::operator=(Kernel&& other) noexcept {
  std::swap(context_, other.context_);
  std::swap(name_, other.name_);
  std::swap(bindings_, other.bindings_);
  std::swap(push_constant_bytes_, other.push_constant_bytes_);
  std::swap(workgroup_size_, other.workgroup_size_);
  std::swap(set_layout_, other.set_layout_);
  std::swap(layout_, other.layout_);
  std::swap(pipeline_, other.pipeline_);
  return *this;
}

}  // namespace lapwing::gpu
