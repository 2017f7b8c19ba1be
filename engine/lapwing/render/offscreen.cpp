#include "lapwing/render/offscreen.h"

#include <algorithm>
#include <string>

#include "lapwing/base/errors.h"
#include "lapwing/base/limits.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing {

VkExtent2D checked_extent(const gpu::Context& context, std::uint32_t width, std::uint32_t height) {
  require_graphics(context);
  require_at_most(kMostPixels, static_cast<double>(width) * height, "the picture would have",
                  "choose a smaller size");
  const VkPhysicalDeviceLimits& limits = context.limits();
  const std::uint32_t widest = std::min(limits.maxImageDimension2D, limits.maxFramebufferWidth);
  const std::uint32_t highest = std::min(limits.maxImageDimension2D, limits.maxFramebufferHeight);
  if (width >= 1 && height >= 1 && width <= widest && height <= highest) return {width, height};
  throw GpuError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                 " pixels cannot be drawn on " + context.description().name +
                 ": choose a size between 1 x 1 and " + std::to_string(widest) + " x " +
                 std::to_string(highest));
}

OffscreenTarget::OffscreenTarget(gpu::Context& context, std::uint32_t width, std::uint32_t height,
                                 std::uint32_t samples)
    : extent_(checked_extent(context, width, height)),
      format_(antialiased(context, TargetFormat{}.color, samples)),
      color_(context, {"picture", format_.color, extent_, VK_SAMPLE_COUNT_1_BIT,
                       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT}),
      scope_(context, extent_, format_),
      pixels_(context, "pixels", VkDeviceSize{4} * width * height, gpu::Memory::readback),
      commands_(context, "offscreen picture") {}

Image OffscreenTarget::render(const std::function<void(VkCommandBuffer)>& draw) {
  gpu::Recorder recorder(commands_);
  color_.transition(recorder.handle(), kDiscarded, kColorTarget);
  scope_.begin(recorder.handle(), color_.view());
  draw(recorder.handle());
  scope_.end(recorder.handle(), color_.view());
  record_read_back(recorder, color_, extent_, pixels_);
  recorder.finish();
  commands_.run();
  const auto bytes = pixels_.mapped_as<std::uint8_t>();
  return {extent_.width, extent_.height, {bytes.begin(), bytes.end()}};
}

}  // namespace lapwing
