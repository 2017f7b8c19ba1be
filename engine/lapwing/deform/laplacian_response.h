#pragma once

#include <span>
#include <vector>

#include "lapwing/deform/edit_system.h"

namespace lapwing {

/// The linear response by the n x n system, in which Laplacian coordinates and edges keep their
/// rest directions: (L'Om L + K + W) u = W d, the same matrix for x, y and z. Returns four columns
/// for each of `handles` (its coordinates x, y, z and 1), each over the moving vertices
/// (ResponseColumns along axes).
Numbers laplacian_response(const EditSystem& system, std::span<const std::size_t> handles);

/// Whether the springs of an edit's targets act besides its handles.
enum class Springs { pull, ignored };

/// The same for one motion with the prescribed displacements `wanted`. Returns the displacement of
/// every vertex.
std::vector<Eigen::Vector3d> laplacian_displacement(const EditSystem& system,
                                                    std::span<const Eigen::Vector3d> wanted,
                                                    Springs springs = Springs::pull);

}  // namespace lapwing
