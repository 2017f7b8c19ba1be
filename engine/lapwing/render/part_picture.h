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
/// part stands on its boundary loop, which is marked. The view is a little from above and from the
/// front: +z, or +y if the loop faces along z. A flat part is seen broadside. `loop` is one of
/// `boundary_loops`. Throws InputError as LoopCurve does, and GpuError if the device cannot draw.
Image part_picture(const std::shared_ptr<gpu::Context>& context, const Mesh& mesh,
                   std::span<const Index> loop, std::uint32_t side);

/// Side of thumbnails of parts, in pixels.
inline constexpr std::uint32_t kThumbnailSide = 192;

}  // namespace lapwing
