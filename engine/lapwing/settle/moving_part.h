#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"

namespace lapwing {

/// The vertices that still move while most others have settled, with the three rings around them;
/// ascending. They are those whose part of `step` (x of all unknowns, then y, then z) is above a
/// fifth of `largest`, the length of the largest. Empty where they are more than a fifth of the
/// unknowns, or more than 12,000. Linear time.
std::vector<Index> moving_part(const RegionRings& rings, std::span<const double> step,
                               double largest);

}  // namespace lapwing
