#pragma once

#include <cstdint>
#include <optional>

#include <volk.h>

#include "lapwing/base/errors.h"
#include "lapwing/render/device_image.h"

namespace lapwing::viewer {

/// The surface of a screen is lost, but it may be opened again.
class SurfaceLost : public GpuError {
 public:
  using GpuError::GpuError;
};

/// The images that frames are drawn into, in turn: those of a window (Swapchain), or one without a
/// display (OffscreenScreen). Every call may throw SurfaceLost and gpu::DeviceLost.
class Screen {
 public:
  virtual ~Screen() = default;

  /// Returns an _SRGB format, always the same.
  virtual VkFormat format() const = 0;
  /// Returns the size of the images.
  virtual VkExtent2D extent() const = 0;

  /// Creates images for a window of `pixels`, or of the size that the desktop dictates. Returns
  /// false, without images, while the window has no size. There are none before the first call. The
  /// device must have finished drawing into the old ones.
  virtual bool resize(VkExtent2D pixels) = 0;

  /// One image to draw into.
  struct Image {
    std::uint32_t index = 0;
    VkImage handle = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkSemaphore ready = VK_NULL_HANDLE;  ///< to wait for before drawing; null if there is no need
    VkSemaphore drawn = VK_NULL_HANDLE;  ///< to signal when it may be shown; null likewise
  };
  /// Returns the next image; nullopt if the images no longer fit the window or none becomes free.
  /// Then call `resize`.
  virtual std::optional<Image> acquire() = 0;
  /// Returns the state in which `present` takes an image.
  virtual ImageState shown() const = 0;
  /// Shows an image once its `drawn` is signalled. Returns false if the images no longer fit.
  virtual bool present(const Image& image) = 0;
};

}  // namespace lapwing::viewer
