#pragma once

#include <cstdint>
#include <optional>

#include <volk.h>

#include "lapwing/base/errors.h"
#include "lapwing/render/device_image.h"

namespace lapwing::viewer {

/// Thrown if the surface of a screen is lost. The screen may be opened again.
class SurfaceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

/// The images into which frames are drawn: those of a window (Swapchain), or one image without a
/// display (OffscreenScreen). Every call may throw SurfaceLost and gpu::DeviceLost.
class Screen {
 public:
  virtual ~Screen() = default;

  /// Returns the format of the images, an _SRGB format. It never changes.
  virtual VkFormat format() const = 0;
  /// Returns the size of the images.
  virtual VkExtent2D extent() const = 0;

  /// Creates images for a window of size `pixels`, or of the size that the desktop prescribes.
  /// Returns false and creates no images if the size of the window is 0. Before the first call,
  /// there are no images. The device must have finished drawing into the old images.
  virtual bool resize(VkExtent2D pixels) = 0;

  /// An image to draw into.
  struct Image {
    std::uint32_t index = 0;
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore ready = VK_NULL_HANDLE;  ///< wait for it before drawing; null if not necessary
    VkSemaphore drawn = VK_NULL_HANDLE;  ///< signal it after drawing; null if not necessary
  };
  /// Returns the next image. Returns nullopt if the images no longer fit the window or no image
  /// becomes free; the caller must then call `resize`.
  virtual std::optional<Image> acquire() = 0;
  /// Returns the state that an image must have for `present`.
  virtual ImageState shown() const = 0;
  /// Shows an image after its semaphore `drawn` is signalled. Returns false if the images no longer
  /// fit the window.
  virtual bool present(const Image& image) = 0;
};

}  // namespace lapwing::viewer
