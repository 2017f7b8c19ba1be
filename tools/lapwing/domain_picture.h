#pragma once

#include "lapwing/io/image.h"
#include "lapwing/parameterize/parameterize.h"

namespace lapwing::cli {

/// Draws the triangles in the plane on white: the boundary bold, pins as dots, flipped triangles
/// red with a spot that marks even a tiny one. The picture has `size` x `size` pixels and a margin
/// around the domain. Lines are antialiased, and thinner where triangles are small.
Image draw_domain(const Parameterized& result, std::uint32_t size);

}  // namespace lapwing::cli
