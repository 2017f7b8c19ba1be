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

void resolve(VkRenderingAttachmentInfo& color, VkImageView picture) {
  color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
  color.resolveImageView = picture;
  color.resolveImageLayout = kColorTarget.layout;
}

}  // namespace

void record_read_back(gpu::Recorder& recorder, const DeviceImage& image, VkExtent2D extent,
                      const gpu::Buffer& buffer) {
  image.transition(recorder.handle(), kColorTarget, kCopySource);
  recorder.access(buffer, kCopySource.stages, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent.width, extent.height, 1};
  image.context().vk().vkCmdCopyImageToBuffer(recorder.handle(), image.handle(), kCopySource.layout,
                                              buffer.handle(), 1, &region);
}

VkSampleCountFlagBits sample_count(const gpu::Context& context, std::uint32_t wanted) {
  // The flag bit of a sample count has the same value as the count.
  const VkSampleCountFlags supported =
      context.limits().framebufferColorSampleCounts & context.limits().framebufferDepthSampleCounts;
  std::uint32_t best = 1;
  for (std::uint32_t count = 2; count <= std::min(wanted, 64U); count *= 2) {
    if ((supported & count) != 0) best = count;
  }
  return static_cast<VkSampleCountFlagBits>(best);
}

TargetFormat antialiased(const gpu::Context& context, VkFormat color, std::uint32_t samples) {
  TargetFormat format{.color = color, .samples = sample_count(context, samples)};
  format.shaders_encode = context.description().type == "software" &&
                          format.samples != VK_SAMPLE_COUNT_1_BIT &&
                          without_encoding(color) != VK_FORMAT_UNDEFINED;
  return format;
}

DrawScope::DrawScope(const gpu::Context& context, VkExtent2D extent, const TargetFormat& format)
    : context_(context),
      extent_(extent),
      shaders_encode_(format.shaders_encode),
      depth_(context, {"depth", format.depth, extent, format.samples,
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT}) {
  if (format.samples == VK_SAMPLE_COUNT_1_BIT) return;
  multisampled_.emplace(context, DeviceImageInfo{.name = "multisampled picture",
                                                 .format = format.color,
                                                 .extent = extent,
                                                 .samples = format.samples,
                                                 .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
                                                 .second_format = format.drawn_color()});
}

void DrawScope::begin(VkCommandBuffer commands, VkImageView picture) const {
  depth_.transition(commands, kDiscarded, kDepthTarget);
  VkRenderingAttachmentInfo color = attachment(picture, kColorTarget);
  if (multisampled_) {
    multisampled_->transition(commands, kDiscarded, kColorTarget);
    color = attachment(multisampled_->second_view(), kColorTarget);
    if (!shaders_encode_) resolve(color, picture);
  }
  if (!multisampled_ || shaders_encode_) color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  // Depth is reversed: the farthest depth is 0, which is the default clear value.
  const VkRenderingAttachmentInfo depth = attachment(depth_.view(), kDepthTarget);
  begin(commands, color, &depth);
}

void DrawScope::begin(VkCommandBuffer commands, const VkRenderingAttachmentInfo& color,
                      const VkRenderingAttachmentInfo* depth) const {
  VkRenderingInfo scope{VK_STRUCTURE_TYPE_RENDERING_INFO};
  scope.renderArea = {{0, 0}, extent_};
  scope.layerCount = 1;
  scope.colorAttachmentCount = 1;
  scope.pColorAttachments = &color;
  scope.pDepthAttachment = depth;
  context_.vk().vkCmdBeginRendering(commands, &scope);
}

void DrawScope::end(VkCommandBuffer commands, VkImageView picture) const {
  context_.vk().vkCmdEndRendering(commands);
  if (!shaders_encode_) return;
  // Average the samples in linear light: the sRGB view decodes the colours that the shaders
  // encoded.
  multisampled_->transition(commands, kColorTarget, kColorTarget);
  VkRenderingAttachmentInfo color = attachment(multisampled_->view(), kColorTarget);
  color.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  resolve(color, picture);
  begin(commands, color, nullptr);
  context_.vk().vkCmdEndRendering(commands);
}

}  // namespace lapwing
