#include "lapwing/render/graphics_pipeline.h"

#include <array>
#include <stdexcept>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr std::size_t kMaxBuffers = 10;

class ShaderModule {
 public:
  ShaderModule(const gpu::Context& context, std::span<const std::uint32_t> spirv)
      : context_(context) {
    VkShaderModuleCreateInfo info{VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO};
    info.codeSize = spirv.size_bytes();
    info.pCode = spirv.data();
    context.check(context.vk().vkCreateShaderModule(context.device(), &info, nullptr, &handle_),
                  "vkCreateShaderModule");
  }
  ~ShaderModule() { context_.vk().vkDestroyShaderModule(context_.device(), handle_, nullptr); }
  ShaderModule(const ShaderModule&) = delete;
  ShaderModule& operator=(const ShaderModule&) = delete;

  VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind,
                                        const VkSpecializationInfo& constants) const {
    VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
    info.stage = kind;
    info.module = handle_;
    info.pName = "main";
    info.pSpecializationInfo = &constants;
    return info;
  }

 private:
  const gpu::Context& context_;
  VkShaderModule handle_ = VK_NULL_HANDLE;
};

// The states that do not depend on the pipeline, except blending.
struct FixedState {
  VkPipelineVertexInputStateCreateInfo vertex_input{
      VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO};
  VkPipelineInputAssemblyStateCreateInfo assembly{
      VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO};
  VkPipelineViewportStateCreateInfo viewport{VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO};
  VkPipelineRasterizationStateCreateInfo rasterization{
      VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO};
  VkPipelineColorBlendAttachmentState attachment{};
  VkPipelineColorBlendStateCreateInfo blend{
      VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO};
  std::array<VkDynamicState, 3> dynamic_states{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                               VK_DYNAMIC_STATE_CULL_MODE};
  VkPipelineDynamicStateCreateInfo dynamic{VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO};

  explicit FixedState(bool blended) {
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    viewport.viewportCount = 1;
    viewport.scissorCount = 1;
    rasterization.polygonMode = VK_POLYGON_MODE_FILL;
    rasterization.frontFace = VK_FRONT_FACE_COUNTER_CLOCKWISE;
    rasterization.lineWidth = 1.0F;
    attachment.colorWriteMask = VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT |
                                VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    attachment.blendEnable = blended ? VK_TRUE : VK_FALSE;
    attachment.srcColorBlendFactor = VK_BLEND_FACTOR_SRC_ALPHA;
    attachment.dstColorBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    attachment.srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE;
    attachment.dstAlphaBlendFactor = VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA;
    blend.attachmentCount = 1;
    blend.pAttachments = &attachment;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(dynamic_states.size());
    dynamic.pDynamicStates = dynamic_states.data();
  }
  FixedState(const FixedState&) = delete;
  FixedState& operator=(const FixedState&) = delete;
};

VkCullModeFlags culled(Sides sides) {
  switch (sides) {
    case Sides::both:
      return VK_CULL_MODE_NONE;
    case Sides::front:
      return VK_CULL_MODE_BACK_BIT;
    case Sides::back:
      return VK_CULL_MODE_FRONT_BIT;
  }
  return VK_CULL_MODE_NONE;
}

}  // namespace

VkFormat TargetFormat::drawn_color() const {
  return shaders_encode ? without_encoding(color) : color;
}

VkFormat without_encoding(VkFormat srgb) {
  switch (srgb) {
    case VK_FORMAT_R8G8B8A8_SRGB:
      return VK_FORMAT_R8G8B8A8_UNORM;
    case VK_FORMAT_B8G8R8A8_SRGB:
      return VK_FORMAT_B8G8R8A8_UNORM;
    default:
      return VK_FORMAT_UNDEFINED;
  }
}

void require_graphics(const gpu::Context& context) {
  if (context.has_graphics()) return;
  throw GpuError(context.description().name +
                 " cannot draw: it has no queue with both compute and graphics; choose another "
                 "device (`lapwing info` lists them) or do without the picture");
}

GraphicsPipeline::GraphicsPipeline(const gpu::Context& context, const TargetFormat& target,
                                   const GraphicsPipelineInfo& info)
    : context_(context), name_(info.name) {
  require_graphics(context);
  try {
    create_layout(info);
    create_pipeline(target, info);
  } catch (...) {
    release();
    throw;
  }
}

void GraphicsPipeline::create_layout(const GraphicsPipelineInfo& info) {
  std::array<VkDescriptorSetLayoutBinding, kMaxBuffers> bindings{};
  if (info.storage_buffers > bindings.size()) {
    throw std::logic_error(name_ + " needs more buffers than kMaxBuffers");
  }
  for (std::uint32_t b = 0; b < info.storage_buffers; ++b) {
    bindings[b].binding = b;
    bindings[b].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    bindings[b].descriptorCount = 1;
    bindings[b].stageFlags = kStages;
  }
  const auto& vk = context_.vk();
  VkDescriptorSetLayoutCreateInfo set{VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO};
  set.flags = VK_DESCRIPTOR_SET_LAYOUT_CREATE_PUSH_DESCRIPTOR_BIT_KHR;
  set.bindingCount = info.storage_buffers;
  set.pBindings = bindings.data();
  context_.check(vk.vkCreateDescriptorSetLayout(context_.device(), &set, nullptr, &set_layout_),
                 "vkCreateDescriptorSetLayout");

  const VkPushConstantRange push{kStages, 0, info.push_constant_bytes};
  VkPipelineLayoutCreateInfo layout{VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO};
  layout.setLayoutCount = 1;
  layout.pSetLayouts = &set_layout_;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &push;
  context_.check(vk.vkCreatePipelineLayout(context_.device(), &layout, nullptr, &layout_),
                 "vkCreatePipelineLayout");
}

void GraphicsPipeline::create_pipeline(const TargetFormat& target,
                                       const GraphicsPipelineInfo& info) {
  const ShaderModule vertex(context_, info.vertex_spirv);
  const ShaderModule fragment(context_, info.fragment_spirv);
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t c = 0; c < info.constants.size(); ++c) {
    entries.push_back(
        {c, static_cast<std::uint32_t>(c * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                       info.constants.size_bytes(), info.constants.data()};
  const std::array stages{vertex.stage(VK_SHADER_STAGE_VERTEX_BIT, constants),
                          fragment.stage(VK_SHADER_STAGE_FRAGMENT_BIT, constants)};
  VkPipelineMultisampleStateCreateInfo multisample{
      VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO};
  multisample.rasterizationSamples = target.samples;
  VkPipelineDepthStencilStateCreateInfo depth{
      VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
  depth.depthTestEnable = info.depth ? VK_TRUE : VK_FALSE;
  depth.depthWriteEnable = depth.depthTestEnable;
  depth.depthCompareOp = VK_COMPARE_OP_GREATER;
  VkPipelineRenderingCreateInfo rendering{VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO};
  rendering.colorAttachmentCount = 1;
  const VkFormat color = target.drawn_color();
  rendering.pColorAttachmentFormats = &color;
  rendering.depthAttachmentFormat = target.depth;

  const FixedState fixed(info.blend);
  VkGraphicsPipelineCreateInfo create{VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO, &rendering};
  create.stageCount = static_cast<std::uint32_t>(stages.size());
  create.pStages = stages.data();
  create.pVertexInputState = &fixed.vertex_input;
  create.pInputAssemblyState = &fixed.assembly;
  create.pViewportState = &fixed.viewport;
  create.pRasterizationState = &fixed.rasterization;
  create.pMultisampleState = &multisample;
  create.pDepthStencilState = &depth;
  create.pColorBlendState = &fixed.blend;
  create.pDynamicState = &fixed.dynamic;
  create.layout = layout_;
  context_.check(context_.vk().vkCreateGraphicsPipelines(context_.device(), VK_NULL_HANDLE, 1,
                                                         &create, nullptr, &pipeline_),
                 ("vkCreateGraphicsPipelines for " + name_).c_str());
}

void GraphicsPipeline::bind_bytes(VkCommandBuffer commands,
                                  std::span<const gpu::Buffer* const> buffers,
                                  std::span<const std::byte> push, Sides sides) const {
  const VkDeviceSize limit = context_.limits().maxStorageBufferRange;
  std::array<VkDescriptorBufferInfo, kMaxBuffers> infos;
  std::array<VkWriteDescriptorSet, kMaxBuffers> writes;
  for (std::uint32_t b = 0; b < buffers.size(); ++b) {
    if (buffers[b]->bytes() > limit) {
      throw GpuError("drawing " + name_ + ": the buffer \"" + buffers[b]->name() + "\" of " +
                     std::to_string(buffers[b]->bytes()) + " bytes exceeds the limit of " +
                     std::to_string(limit) + " of " + context_.description().name +
                     "; draw a smaller mesh");
    }
    infos[b] = {buffers[b]->handle(), 0, VK_WHOLE_SIZE};
    writes[b] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
    writes[b].dstBinding = b;
    writes[b].descriptorCount = 1;
    writes[b].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    writes[b].pBufferInfo = &infos[b];
  }
  const auto& vk = context_.vk();
  vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_);
  vk.vkCmdSetCullMode(commands, culled(sides));
  if (!buffers.empty()) {
    vk.vkCmdPushDescriptorSetKHR(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0,
                                 static_cast<std::uint32_t>(buffers.size()), writes.data());
  }
  vk.vkCmdPushConstants(commands, layout_, kStages, 0, static_cast<std::uint32_t>(push.size()),
                        push.data());
}

void GraphicsPipeline::draw_vertices(VkCommandBuffer commands, std::uint32_t vertices,
                                     std::uint32_t first) const {
  context_.vk().vkCmdDraw(commands, vertices, 1, first, 0);
}

void GraphicsPipeline::draw_indices(VkCommandBuffer commands, const IndexRange& indices) const {
  context_.vk().vkCmdBindIndexBuffer(commands, indices.buffer->handle(), 0, VK_INDEX_TYPE_UINT32);
  context_.vk().vkCmdDrawIndexed(commands, indices.count, 1, indices.first, 0, 0);
}

void GraphicsPipeline::release() noexcept {
  const auto& vk = context_.vk();
  const VkDevice device = context_.device();
  if (pipeline_ != VK_NULL_HANDLE) vk.vkDestroyPipeline(device, pipeline_, nullptr);
  if (layout_ != VK_NULL_HANDLE) vk.vkDestroyPipelineLayout(device, layout_, nullptr);
  if (set_layout_ != VK_NULL_HANDLE) {
    vk.vkDestroyDescriptorSetLayout(device, set_layout_, nullptr);
  }
}

GraphicsPipeline::~GraphicsPipeline() {
  release();
}

}  // namespace lapwing
