#pragma once

#include <span>

#include "lapwing/patch/patch.h"

namespace lapwing {

/// Halves every inner edge of the patch that joins two vertices of its loop, and splits the
/// triangles on both sides. The patch must have no midpoints yet; `sides` are those of its
/// triangles.
void halve_chords(Patch& patch, const Adjacency& sides);

}  // namespace lapwing
