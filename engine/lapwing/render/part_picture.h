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

/// A picture of a part for transplanting, `side` pixels wide and high, on nothing: it stands on its
/// boundary loop, which is marked, and is seen a little from above, from the front (+z; where the
/// loop faces there, +y), or across where it is flat. `loop` as
/// boundary_loops has it. Throws InputError for a loop as in LoopCurve, and GpuError for a device
/// that cannot draw.
Image part_picture(const std::shared_ptr<gpu::Context>& context, const Mesh& mesh,
                   std::span<const Index> loop, std::uint32_t side);

/// The side of the pictures beside parts.
inline constexpr std::uint32_t kThumbnailSide = 192;

}  // namespace lapwing
