#pragma once

#include <span>
#include <string>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Sizes of meshes that the engine supports: all that 32-bit floats can hold (1e-38 to 3e38). The
/// mathematics uses up to the sixth power of edge lengths, which doubles hold even for edges of a
/// ten-thousandth of the size.
inline constexpr double kSmallestExtent = 1e-38;
inline constexpr double kLargestExtent = 1e39;

/// Returns the largest side of the bounding box of the vertices with finite positions, or 0 if they
/// coincide. Throws InputError, naming `where`, if any other size is outside those limits.
double require_extent(std::span<const Index> vertices, std::span<const Eigen::Vector3d> positions,
                      const std::string& where);

}  // namespace lapwing
