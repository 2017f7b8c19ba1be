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
  double depth = 0.0;  ///< distance from the eye along the viewing direction
};

/// An image of the triangle that is visible at each pixel, for picking and for selecting visible
/// vertices. Includes back faces. Not thread-safe. The context must outlive it.
class IdPicture {
 public:
  /// Throws GpuError if the context's queue has no graphics support.
  explicit IdPicture(gpu::Context& context);

  /// Draws `surface` at its current positions as an image of `width` x `height` pixels and reads
  /// the image back. Throws GpuError if the device cannot draw this size.
  void draw(Surface& surface, const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Returns for each pixel, by rows from the top, 1 + the index of the triangle at its centre, or
  /// 0 for the background. Empty before the first `draw`.
  std::span<const std::uint32_t> ids() const;

  /// Returns the point of `surface` at column `x` and row `y` of the last image, or nothing for the
  /// background and outside the image. The surface must not have moved since `draw`.
  std::optional<Pick> pick(const Surface& surface, std::uint32_t x, std::uint32_t y);

 private:
  /// Resources that depend on the size of the image.
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
