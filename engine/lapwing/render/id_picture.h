#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include "lapwing/gpu/buffer.h"
#include "lapwing/gpu/command_list.h"
#include "lapwing/gpu/transfer.h"
#include "lapwing/mesh/mesh.h"
#include "lapwing/render/camera.h"
#include "lapwing/render/device_image.h"
#include "lapwing/render/draw_scope.h"
#include "lapwing/render/graphics_pipeline.h"

namespace lapwing {

class Surface;

/// A point picked on a surface.
struct Pick {
  Index triangle = kNoIndex;
  Index vertex = kNoIndex;  ///< the triangle's corner that is nearest to `position`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in mesh coordinates
  double depth = 0.0;  ///< distance from the eye's plane along the viewing direction
};

/// A picture of triangle numbers: which triangle is visible at each pixel, from either side. For
/// picking and for selecting what is visible. Not thread-safe. The context must outlive it.
class IdPicture {
 public:
  /// Throws GpuError if the context's queue has no graphics.
  explicit IdPicture(gpu::Context& context);

  /// Draws the current buffers of `surface` as a picture of `width` x `height` pixels and reads the
  /// numbers back. Throws GpuError if the device cannot draw this size.
  void draw(Surface& surface, const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Returns 1 + the number of the triangle at each pixel's centre, or 0, in rows from the top.
  /// Empty before the first `draw`.
  std::span<const std::uint32_t> ids() const;

  /// Returns the point at column `x` and row `y` of the last picture of `surface`, which must not
  /// have moved since. Returns nothing on the background and outside the picture.
  std::optional<Pick> pick(const Surface& surface, std::uint32_t x, std::uint32_t y);

 private:
  /// Resources that depend on the picture's size.
  struct Target {
    Target(gpu::Context& context, VkExtent2D extent, const TargetFormat& format);

    VkExtent2D extent;
    DeviceImage ids;
    DrawScope scope;
    gpu::Buffer read_back;
  };

  void record(const Surface& surface);

  gpu::Context& context_;
  GraphicsPipeline pipeline_;
  gpu::CommandList commands_;
  gpu::Transfer transfer_;
  std::optional<Target> target_;
  Camera camera_;
};

}  // namespace lapwing
