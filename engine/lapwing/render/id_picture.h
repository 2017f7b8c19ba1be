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

/// A place on a surface.
struct Pick {
  Index triangle = kNoIndex;
  Index vertex = kNoIndex;  ///< the triangle's corner that is nearest to `position`
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in mesh coordinates
  double depth = 0.0;  ///< distance from the eye's plane along the viewing direction
};

/// Which triangle shows at each pixel of a picture, both faces of the surface counting. For picking
/// and for selecting what is visible. Not for use from several threads at once. The context must
/// outlive it.
class IdPicture {
 public:
  /// Throws GpuError when the context's queue has no graphics.
  explicit IdPicture(gpu::Context& context);

  /// Draws `surface`, from its buffers as they are now, as a picture of `width` x `height` pixels,
  /// and reads the numbers back. Throws GpuError for a size that the device cannot draw.
  void draw(Surface& surface, const Camera& camera, std::uint32_t width, std::uint32_t height);

  /// Rows from the top: 1 + the number of the triangle that shows at the pixel's centre, or 0.
  /// Empty before the first `draw`.
  std::span<const std::uint32_t> ids() const;

  /// What shows at column `x` and row `y` of the picture last drawn of `surface`, which must not
  /// have moved since. Nothing where the background does, and outside the picture.
  std::optional<Pick> pick(const Surface& surface, std::uint32_t x, std::uint32_t y);

 private:
  /// What depends on the picture's size.
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
