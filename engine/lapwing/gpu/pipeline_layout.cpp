#include "lapwing/gpu/pipeline_layout.h"

#include <array>
#include <stdexcept>

namespace lapwing::gpu {

PipelineLayout::PipelineLayout(const Context& context, VkShaderStageFlags stages,
                               std::uint32_t buffers, std::uint32_t push_constant_bytes)
    : context_(&context), stages_(stages) {
  if (buffers > kMaxBuffers) throw std::logic_error("a pipeline with more than kMaxBuffers");
  std::array<VkDescriptorSetLayoutBinding, kMaxBuffers> bindings{};
  for (std::uint32_t b = 0; b < buffers; ++b) {
    bindings[b].binding = b;
    bindings[b].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    bindings[b].descriptorCount = 1;
    bindings[b].stageFlags = stages;
  }
  const auto& vk = context.vk();
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = buffers;
  set.pBindings = bindings.data();
  set_ = create(context, vk.vkCreateDescriptorSetLayout, vk.vkDestroyDescriptorSetLayout, set,
                "vkCreateDescriptorSetLayout");

  const VkDescriptorSetLayout set_handle = set_.get();
  const VkPushConstantRange push{stages, 0, push_constant_bytes};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_handle;
  layout.pushConstantRangeCount = push_constant_bytes == 0 ? 0 : 1;
  layout.pPushConstantRanges = &push;
  layout_ = create(context, vk.vkCreatePipelineLayout, vk.vkDestroyPipelineLayout, layout,
                   "vkCreatePipelineLayout");
}

void PipelineLayout::bind(VkCommandBuffer commands, VkPipelineBindPoint point, VkPipeline pipeline,
                          std::span<const BufferRange> buffers,
                          std::span<const std::byte> push) const {
  std::array<VkDescriptorBufferInfo, kMaxBuffers> infos;
  std::array<VkWriteDescriptorSet, kMaxBuffers> writes;
  for (std::uint32_t b = 0; b < buffers.size(); ++b) {
    const BufferRange& range = buffers[b];
    // An empty range cannot be bound. The whole buffer is bound instead, and the shader does not
    // read it.
    infos[b] = {range.buffer->handle(), range.offset,
                range.bytes == 0 ? VK_WHOLE_SIZE : range.bytes};
    writes[b] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[b].dstBinding = b;
    writes[b].descriptorCount = 1;
    writes[b].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[b].pBufferInfo = &infos[b];
  }
  const auto& vk = context_->vk();
  vk.vkCmdBindPipeline(commands, point, pipeline);
  if (!buffers.empty()) {
    vk.vkCmdPushDescriptorSetKHR(commands, point, handle(), 0,
                                 static_cast<std::uint32_t>(buffers.size()), writes.data());
  }
  if (!push.empty()) {
    vk.vkCmdPushConstants(commands, handle(), stages_, 0, static_cast<std::uint32_t>(push.size()),
                          push.data());
  }
}

Owned<VkShaderModule> shader_module(const Context& context, std::span<const std::uint32_t> spirv) {
  VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  const auto& vk = context.vk();
  return create(context, vk.vkCreateShaderModule, vk.vkDestroyShaderModule, info,
                "vkCreateShaderModule");
}

}  // namespace lapwing::gpu
