#pragma once

#include <cstddef>

#include "lapwing/coating/layered_coat.h"

namespace lapwing::viewer {

/// The domain with the edges of both patches drawn in it, the source's below, as wide as the panel
/// is. Without `layers`, only its frame.
void draw_domain(const LayeredCoat* layers, std::size_t source);

}  // namespace lapwing::viewer
