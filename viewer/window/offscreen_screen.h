#pragma once

#include <optional>

#include "lapwing/io/image.h"
#include "window/screen.h"

namespace lapwing::viewer {

/// A screen with a single image and without a display, for benchmarks and tests. The context must
/// outlive it.
class OffscreenScreen final : public Screen {
 public:
  explicit OffscreenScreen(gpu::Context& context) : context_(context) {}

  VkFormat format() const override { return VK_FORMAT_R8G8B8A8_SRGB; }
  VkExtent2D extent() const override { return extent_; }
  bool resize(VkExtent2D pixels) override;
  std::optional<Image> acquire() override;
  ImageState shown() const override;
  bool present(const Image& image) override;

  /// Waits until the last presented image is drawn, and returns it. Call `present` first.
  lapwing::Image picture();

 private:
  gpu::Context& context_;
  VkExtent2D extent_{};
  std::optional<DeviceImage> image_;
};

}  // namespace lapwing::viewer
