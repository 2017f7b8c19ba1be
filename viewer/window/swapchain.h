#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <volk.h>

#include "lapwing/render/device_image.h"

namespace lapwing::gpu {
class Context;
}

namespace lapwing::viewer {

/// The images of a window that the screen shows in turn. The context and the surface must outlive
/// it.
class Swapchain {
 public:
  /// Throws GpuError when the context's device cannot show anything on the surface. There are no
  /// images before the first `resize`.
  Swapchain(gpu::Context& context, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// An _SRGB one.
  VkFormat format() const { return format_.format; }
  /// Of the images.
  VkExtent2D extent() const { return extent_; }

  /// Makes new images for a window of `pixels`, or as large as the desktop insists on. False, and
  /// no images, while the window has no size. What was submitted to draw into the old ones must be
  /// done.
  bool resize(VkExtent2D pixels);

  /// One image to draw into.
  struct Image {
    std::uint32_t index = 0;
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore drawn = VK_NULL_HANDLE;  ///< to be signalled when it may be shown
  };
  /// The next image; `ready` is signalled when it may be drawn into. None where the images no
  /// longer fit the window: `resize`, then.
  std::optional<Image> acquire(VkSemaphore ready);
  /// Shows an image once its `drawn` is signalled. False where the images no longer fit.
  bool present(const Image& image);

  /// Records a barrier from an image's old contents, or from being drawn into, to the state given.
  void transition(VkCommandBuffer commands, const Image& image, const ImageState& from,
                  const ImageState& to) const;

 private:
  void choose_format();
  void create_images(VkExtent2D pixels, const VkSurfaceCapabilitiesKHR& can);
  void destroy_views();

  gpu::Context& context_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkExtent2D extent_{};
  VkSwapchainKHR handle_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  /// One per image, kept from one swapchain to the next: the screen may still wait for one of them
  /// when its images are replaced.
  std::vector<VkSemaphore> drawn_;
};

/// A binary semaphore.
VkSemaphore make_semaphore(const gpu::Context& context);

}  // namespace lapwing::viewer
