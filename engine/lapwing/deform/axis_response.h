#pragma once

#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// How a region follows its handles when its Laplacian coordinates stay as they are, and do not
/// turn with them: (L'L + W) u = W d, x, y and z by the same numbers. Four columns a handle (its
/// coordinates x, y, z and 1), each over the moving vertices, as DeformedSurface::set_axis_basis
/// takes them. The n x n system of `system` is held.
Numbers axis_response(const EditSystem& system);

/// u of the moving vertices = sum of those columns under `parameters`, 12 a handle; others stay.
void blend_axis_response(std::span<const Index> moving, std::span<const double> columns,
                         std::span<const double> parameters, std::span<Eigen::Vector3d> u);

}  // namespace lapwing
