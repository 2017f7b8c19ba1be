#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "lapwing/io/image.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

namespace gpu {
class Context;
}

/// Draws a part for transplanting on a transparent background, `side` pixels wide and high. The
/// part's boundary loop is at the bottom and is marked. The camera is slightly above the front (+z,
/// or +y if the normal of the loop is along z). A flat part is seen from its broad side. `loop` is
/// one of `boundary_loops`. Throws InputError as LoopCurve does, and GpuError if the device cannot
/// draw.
Image part_picture(const std::shared_ptr<gpu::Context>& context, const Mesh& mesh,
                   std::span<const Index> loop, std::uint32_t side);

/// Width and height of thumbnails of parts, in pixels.
inline constexpr std::uint32_t kThumbnailSide = 192;

}  // namespace lapwing
