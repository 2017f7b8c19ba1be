#pragma once

#include <span>
#include <vector>

#include "lapwing/laplacian/region_rings.h"

namespace lapwing {

/// The vertices that still move while nearly all others have settled, with the three rings around
/// them; ascending. Empty where they are more than a few in a hundred of the unknowns. They are
/// those whose part of `step` (x of all unknowns, then y, then z) is above a twentieth of
/// `largest`, the length of the largest. Linear time.
std::vector<Index> moving_part(const RegionRings& rings, std::span<const double> step,
                               double largest);

}  // namespace lapwing
