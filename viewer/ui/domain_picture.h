#pragma once

#include <cstddef>

#include "lapwing/coating/layered_coat.h"

namespace lapwing::viewer {

/// Draws the domain with the edges of both patches, the source's below, as wide as the panel.
/// Without `layers`, draws only the frame.
void draw_domain(const LayeredCoat* layers, std::size_t source);

}  // namespace lapwing::viewer
