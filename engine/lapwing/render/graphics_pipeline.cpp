#include "lapwing/render/graphics_pipeline.h"

#include <array>
#include <vector>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits kind, VkShaderModule module,
                                      const VkSpecializationInfo& constants) {
  VkPipelineShaderStageCreateInfo info{VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO};
  info.stage = kind;
  info.module = module;
  info.pName = "main";
  info.pSpecializationInfo = &constants;
  return info;
}

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

const gpu::Context& checked(const gpu::Context& context) {
  require_graphics(context);
  return context;
}

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

void set_scissor(const gpu::Context& context, VkCommandBuffer commands, const VkRect2D& area) {
  context.vk().vkCmdSetScissor(commands, 0, 1, &area);
}

void set_viewport(const gpu::Context& context, VkCommandBuffer commands, const VkRect2D& area) {
  const VkViewport viewport{static_cast<float>(area.offset.x),
                            static_cast<float>(area.offset.y),
                            static_cast<float>(area.extent.width),
                            static_cast<float>(area.extent.height),
                            0.0F,
                            1.0F};
  context.vk().vkCmdSetViewport(commands, 0, 1, &viewport);
  set_scissor(context, commands, area);
}

GraphicsPipeline::GraphicsPipeline(const gpu::Context& context, const TargetFormat& target,
                                   const GraphicsPipelineInfo& info)
    : context_(checked(context)),
      name_(info.name),
      layout_(context, kStages, info.storage_buffers, info.push_constant_bytes) {
  create_pipeline(target, info);
}

void GraphicsPipeline::create_pipeline(const TargetFormat& target,
                                       const GraphicsPipelineInfo& info) {
  const auto vertex = gpu::shader_module(context_, info.vertex_spirv);
  const auto fragment = gpu::shader_module(context_, info.fragment_spirv);
  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t c = 0; c < info.constants.size(); ++c) {
    entries.push_back(
        {c, static_cast<std::uint32_t>(c * sizeof(std::uint32_t)), sizeof(std::uint32_t)});
  }
  const VkSpecializationInfo constants{static_cast<std::uint32_t>(entries.size()), entries.data(),
                                       info.constants.size_bytes(), info.constants.data()};
  const std::array stages{stage(VK_SHADER_STAGE_VERTEX_BIT, vertex.get(), constants),
                          stage(VK_SHADER_STAGE_FRAGMENT_BIT, fragment.get(), constants)};
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
  create.layout = layout_.handle();
  const auto& vk = context_.vk();
  VkPipeline pipeline = VK_NULL_HANDLE;
  context_.check(vk.vkCreateGraphicsPipelines(context_.device(), VK_NULL_HANDLE, 1, &create,
                                              nullptr, &pipeline),
                 ("vkCreateGraphicsPipelines for " + name_).c_str());
  pipeline_ = {context_, pipeline, vk.vkDestroyPipeline};
}

void GraphicsPipeline::bind_bytes(VkCommandBuffer commands,
                                  std::span<const gpu::BufferRange> buffers,
                                  std::span<const std::byte> push, Sides sides) const {
  const VkDeviceSize limit = context_.limits().maxStorageBufferRange;
  for (const gpu::BufferRange& range : buffers) {
    if (range.bytes <= limit) continue;
    throw GpuError("drawing " + name_ + ": the buffer \"" + range.buffer->name() + "\" of " +
                   std::to_string(range.bytes) + " bytes exceeds the limit of " +
                   std::to_string(limit) + " of " + context_.description().name +
                   "; draw a smaller mesh");
  }
  layout_.bind(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get(), buffers, push);
  context_.vk().vkCmdSetCullMode(commands, culled(sides));
}

void GraphicsPipeline::draw_vertices(VkCommandBuffer commands, std::uint32_t vertices,
                                     std::uint32_t first) const {
  context_.vk().vkCmdDraw(commands, vertices, 1, first, 0);
}

void GraphicsPipeline::draw_indices(VkCommandBuffer commands, const IndexRange& indices) const {
  context_.vk().vkCmdBindIndexBuffer(commands, indices.buffer->handle(), 0, VK_INDEX_TYPE_UINT32);
  context_.vk().vkCmdDrawIndexed(commands, indices.count, 1, indices.first, 0, 0);
}

}  // namespace lapwing
