#pragma once

#include <string>
#include <vector>

#include "lapwing/deform/certificate.h"

namespace lapwing {

/// Returns warnings for the user about an unsettled surface, the handle error, flipped triangles,
/// an inside-out surface and long edges. Each warning names a vertex if possible, and gives advice.
/// The list is empty for a good result.
std::vector<std::string> warnings_of(const Certificate& certificate);

/// `warnings_of` adds a warning if more than this fraction of the region is inside out.
inline constexpr double kMostInsideOut = 0.01;

/// `warnings_of` warns of an edge longer than this factor times its prescribed length.
inline constexpr double kLongEdge = 3.0;

/// Returns true if the handle error exceeds 1% of the mesh's diagonal or a quarter of the
/// prescribed motion. The first limit corresponds to about 8 pixels in a window that shows the
/// whole mesh. The second limit applies if the region is much smaller than the mesh. For handles
/// without a weight, the error is less than a hundredth of their motion (DeformOptions).
bool misses_handles(const Certificate& certificate);

}  // namespace lapwing
