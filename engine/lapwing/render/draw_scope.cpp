#include "lapwing/render/draw_scope.h"

#include <algorithm>

#include "lapwing/gpu/context.h"

namespace lapwing {
namespace {

constexpr ImageState kDepthTarget{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

VkRenderingAttachmentInfo attachment(VkImageView view, const ImageState& state) {
  VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  info.imageView = view;
  info.imageLayout = state.layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  return info;
}

}  // namespace

VkSampleCountFlagBits sample_count(const gpu::Context& context, std::uint32_t wanted) {
  // A sample count is its own bit.
  const VkSampleCountFlags supported =
      context.limits().framebufferColorSampleCounts & context.limits().framebufferDepthSampleCounts;
  std::uint32_t best = 1;
  for (std::uint32_t count = 2; count <= std::min(wanted, 64U); count *= 2) {
    if ((supported & count) != 0) best = count;
  }
  return static_cast<VkSampleCountFlagBits>(best);
}

DrawScope::DrawScope(const gpu::Context& context, VkExtent2D extent, const TargetFormat& format)
    : context_(context),
      extent_(extent),
      depth_(context, {"depth", format.depth, extent, format.samples,
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT}) {
  if (format.samples == VK_SAMPLE_COUNT_1_BIT) return;
  multisampled_.emplace(
      context, DeviceImageInfo{"multisampled picture", format.color, extent, format.samples,
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT});
}

void DrawScope::begin(VkCommandBuffer commands, VkImageView picture) const {
  depth_.transition(commands, kDiscarded, kDepthTarget);
  VkRenderingAttachmentInfo color = attachment(picture, kColorTarget);
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  if (multisampled_) {
    multisampled_->transition(commands, kDiscarded, kColorTarget);
    color = attachment(multisampled_->view(), kColorTarget);
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = picture;
    color.resolveImageLayout = kColorTarget.layout;
  }
  // Depth is reversed: the farthest is 0, which is what a zeroed clear value says.
  const VkRenderingAttachmentInfo depth = attachment(depth_.view(), kDepthTarget);
  VkRenderingInfo scope{VK_STRUCTURE_TYPE_RENDERING_INFO};
  scope.renderArea = {{0, 0}, extent_};
  scope.layerCount = 1;
  scope.colorAttachmentCount = 1;
  scope.pColorAttachments = &color;
  scope.pDepthAttachment = &depth;
  context_.vk().vkCmdBeginRendering(commands, &scope);
}

void DrawScope::end(VkCommandBuffer commands) const {
  context_.vk().vkCmdEndRendering(commands);
}

}  // namespace lapwing
