#include "window/offscreen_screen.h"

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/context.h"
#include "lapwing/gpu/recorder.h"

namespace lapwing::viewer {

bool OffscreenScreen::resize(VkExtent2D pixels) {
  image_.reset();
  extent_ = pixels;
  if (pixels.width == 0 || pixels.height == 0) return false;
  image_.emplace(context_, DeviceImageInfo{.name = "frame",
                                           .format = format(),
                                           .extent = pixels,
                                           .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                                    VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                                                    VK_IMAGE_USAGE_TRANSFER_SRC_BIT});
  return true;
}

std::optional<Screen::Image> OffscreenScreen::acquire() {
  if (!image_) return {};
  return Image{.handle = image_->handle(), .view = image_->view()};
}

ImageState OffscreenScreen::shown() const {
  return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
          VK_ACCESS_2_TRANSFER_READ_BIT};
}

bool OffscreenScreen::present(const Image&) {
  return true;
}

lapwing::Image OffscreenScreen::picture() {
  const gpu::Buffer pixels(context_, "pixels of a frame",
                           VkDeviceSize{4} * extent_.width * extent_.height, gpu::Memory::readback);
  gpu::CommandList commands(context_, "pixels of a frame");
  gpu::Recorder recorder(commands);
  recorder.access(pixels, shown().stages, VK_ACCESS_2_TRANSFER_WRITE_BIT);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent_.width, extent_.height, 1};
  context_.vk().vkCmdCopyImageToBuffer(recorder.handle(), image_->handle(), shown().layout,
                                       pixels.handle(), 1, &region);
  recorder.finish();
  commands.run();
  const auto bytes = pixels.mapped_as<std::uint8_t>();
  return {extent_.width, extent_.height, {bytes.begin(), bytes.end()}};
}

}  // namespace lapwing::viewer
