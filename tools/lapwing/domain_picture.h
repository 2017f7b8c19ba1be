#pragma once

#include "lapwing/io/image.h"
#include "lapwing/parameterize/parameterize.h"

namespace lapwing::cli {

/// Draws the triangles of the parameter domain on a white background. The boundary is bold, and
/// pinned vertices are dots. Flipped triangles are red and have a spot, so that even tiny ones are
/// visible. The image has `size` x `size` pixels, including a margin. Lines are antialiased, and
/// thinner if the triangles are small.
Image draw_domain(const Parameterized& result, std::uint32_t size);

}  // namespace lapwing::cli
