#pragma once

#include <span>
#include <string>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The sizes of what can be computed with: all that meshes of 32-bit floats can have, which end at
/// 1e-38 and 3e38. The mathematics goes up to sixth powers of edge lengths, which double precision
/// holds for edges a ten-thousandth as long.
inline constexpr double kSmallestExtent = 1e-38;
inline constexpr double kLargestExtent = 1e39;

/// The largest side of the box around those vertices that have finite positions; 0 where all are at
/// one place. Throws InputError, naming `where`, for any other size beyond those two.
double require_extent(std::span<const Index> vertices, std::span<const Eigen::Vector3d> positions,
                      const std::string& where);

}  // namespace lapwing
