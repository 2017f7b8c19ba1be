#pragma once

#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// How a region follows its handles when its Laplacian coordinates stay as they are, and do not
/// turn with them: (L'L + W) u = W d, x, y and z by the same numbers. Four columns for each of
/// `handles` (its coordinates x, y, z and 1), each over the moving vertices: ResponseColumns along
/// axes. The n x n system of `system` is held.
Numbers axis_response(const EditSystem& system, std::span<const std::size_t> handles);

/// Whether the targets of an edit count beside what its handles ask for.
enum class Springs { pull, rest };

/// The same for one motion, which asks for `wanted`: the displacement of every vertex.
std::vector<Eigen::Vector3d> axis_displacement(const EditSystem& system,
                                               std::span<const Eigen::Vector3d> wanted,
                                               Springs springs = Springs::pull);

}  // namespace lapwing
