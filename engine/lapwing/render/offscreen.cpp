#include "lapwing/render/offscreen.h"

#include <algorithm>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing {
namespace {

constexpr ImageState kColorTarget{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr ImageState kDepthTarget{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr ImageState kCopySource{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                 VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                 VK_ACCESS_2_TRANSFER_READ_BIT};
// The recorder's first barrier has already waited for whoever used the image before.
constexpr ImageState kDiscarded{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                VK_ACCESS_2_NONE};

VkExtent2D checked_extent(const gpu::Context& context, std::uint32_t width, std::uint32_t height) {
  require_graphics(context);
  const VkPhysicalDeviceLimits& limits = context.limits();
  const std::uint32_t widest = std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth);
  const std::uint32_t highest = std::min(limits.maxImageDimension2D, limits.maxFramebufferHeight);
  if (width >= 1 && height >= 1 && width <= widest && height <= highest) return {width, height};
  throw GpuError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                 " pixels cannot be drawn on " + context.description().name +
                 ": choose a size between 1 x 1 and " + std::to_string(widest) + " x " +
                 std::to_string(highest));
}

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

VkRenderingAttachmentInfo attachment(const DeviceImage& image, const ImageState& state) {
  VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
  info.imageView = image.view();
  info.imageLayout = state.layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  info.storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  return info;
}

constexpr VkImageUsageFlags kDrawn = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;

}  // namespace

OffscreenTarget::OffscreenTarget(gpu::Context& context, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t samples)
    : context_(context),
      extent_(checked_extent(context, width, height)),
      format_{.samples = sample_count(context, samples)},
      color_(context, {"picture", format_.color, extent_, VK_SAMPLE_COUNT_1_BIT,
                       kDrawn | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}),
      depth_(context, {"depth", format_.depth, extent_, format_.samples,
                       VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_IMAGE_ASPECT_DEPTH_BIT}),
      pixels_(context, "pixels", VkDeviceSize{4} * width * height, gpu::Memory::readback),
      commands_(context, "offscreen picture") {
  if (format_.samples == VK_SAMPLE_COUNT_1_BIT) return;
  multisampled_.emplace(context, DeviceImageInfo{"multisampled picture", format_.color, extent_,
                                                 format_.samples, kDrawn});
}

void OffscreenTarget::record_scope(VkCommandBuffer commands,
                                   const std::function<void(VkCommandBuffer)>& draw) {
  color_.transition(commands, kDiscarded, kColorTarget);
  depth_.transition(commands, kDiscarded, kDepthTarget);
  VkRenderingAttachmentInfo color = attachment(color_, kColorTarget);
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  if (multisampled_) {
    multisampled_->transition(commands, kDiscarded, kColorTarget);
    color = attachment(*multisampled_, kColorTarget);
    color.resolveMode = VK_RESOLVE_MODE_AVERAGE_BIT;
    color.resolveImageView = color_.view();
    color.resolveImageLayout = kColorTarget.layout;
  }
  // Depth is reversed: the farthest is 0, which is what a zeroed clear value says.
  const VkRenderingAttachmentInfo depth = attachment(depth_, kDepthTarget);
  VkRenderingInfo scope{VK_STRUCTURE_TYPE_RENDERING_INFO};
  scope.renderArea = {{0, 0}, extent_};
  scope.layerCount = 1;
  scope.colorAttachmentCount = 1;
  scope.pColorAttachments = &color;
  scope.pDepthAttachment = &depth;
  context_.vk().vkCmdBeginRendering(commands, &scope);
  draw(commands);
  context_.vk().vkCmdEndRendering(commands);
}

Image OffscreenTarget::render(const std::function<void(VkCommandBuffer)>& draw) {
  gpu::Recorder recorder(commands_);
  record_scope(recorder.handle(), draw);
  color_.transition(recorder.handle(), kColorTarget, kCopySource);
  recorder.access(pixels_, kCopySource.stages, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent_.width, extent_.height, 1};
  context_.vk().vkCmdCopyImageToBuffer(recorder.handle(), color_.handle(), kCopySource.layout,
                                       pixels_.handle(), 1, &region);
  recorder.finish();
  commands_.run();
  const auto bytes = pixels_.mapped_as<std::uint8_t>();
  return {extent_.width, extent_.height, {bytes.begin(), bytes.end()}};
}

}  // namespace lapwing
