#pragma once

#include <cstdint>
#include <optional>

#include <volk.h>

#include "lapwing/base/errors.h"
#include "lapwing/render/device_image.h"

namespace lapwing::viewer {

/// What a screen showed its pictures on is gone, but it may be opened again.
class SurfaceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

/// What frames are shown on: images that are drawn into in turn. A window's (Swapchain), or some
/// that nobody sees (OffscreenScreen). Every call may throw SurfaceLost and gpu::DeviceLost.
class Screen {
 public:
  virtual ~Screen() = default;

  /// An _SRGB one, the same always.
  virtual VkFormat format() const = 0;
  /// Of the images.
  virtual VkExtent2D extent() const = 0;

  /// Makes new images for a window of `pixels`, or as large as the desktop insists on. False, and
  /// no images, while the window has no size; there are none before the first call either. What was
  /// submitted to draw into the old ones must be done.
  virtual bool resize(VkExtent2D pixels) = 0;

  /// One image to draw into.
  struct Image {
    std::uint32_t index = 0;
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore ready = VK_NULL_HANDLE;  ///< to wait for before drawing; null if there is no need
    VkSemaphore drawn = VK_NULL_HANDLE;  ///< to signal when it may be shown; null likewise
  };
  /// The next image. None where the images no longer fit the window, or none comes free: `resize`,
  /// then.
  virtual std::optional<Image> acquire() = 0;
  /// The state in which `present` takes an image.
  virtual ImageState shown() const = 0;
  /// Shows an image once its `drawn` is signalled. False where the images no longer fit.
  virtual bool present(const Image& image) = 0;
};

}  // namespace lapwing::viewer
