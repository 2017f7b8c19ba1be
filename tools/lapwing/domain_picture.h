#pragma once

#include "lapwing/io/image.h"
#include "lapwing/parameterize/parameterize.h"

namespace lapwing::cli {

/// Draws the triangles of the parameter plane on white. The boundary is bold and pins are dots.
/// Flipped triangles are red and have a spot, so that tiny ones are visible. The picture has `size`
/// x `size` pixels and a margin. Lines are antialiased, and thinner if triangles are small.
Image draw_domain(const Parameterized& result, std::uint32_t size);

}  // namespace lapwing::cli
