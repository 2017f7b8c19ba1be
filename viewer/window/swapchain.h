#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <volk.h>

#include "window/screen.h"

namespace lapwing::gpu {
class Context;
}

namespace lapwing::viewer {

class Window;

/// The swapchain of a window. The context and the window must outlive it. A window has at most one
/// swapchain.
class Swapchain final : public Screen {
 public:
  /// Throws GpuError if the context's device cannot present images in the window.
  Swapchain(gpu::Context& context, const Window& window);
  ~Swapchain() override;
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  VkFormat format() const override { return format_.format; }
  VkExtent2D extent() const override { return extent_; }
  bool resize(VkExtent2D pixels) override;
  std::optional<Image> acquire() override;
  ImageState shown() const override;
  bool present(const Image& image) override;

 private:
  void check_support() const;
  void choose_format();
  void create_images(VkExtent2D pixels, const VkSurfaceCapabilitiesKHR& can);
  void destroy_views();
  void release() noexcept;
  void check(VkResult result, const char* call) const;

  gpu::Context& context_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  VkSwapchainKHR handle_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  VkSemaphore ready_ = VK_NULL_HANDLE;
  /// One per image. They are not destroyed in `resize`, because the desktop may still wait for one
  /// of them when the images are replaced.
  std::vector<VkSemaphore> drawn_;
};

}  // namespace lapwing::viewer
