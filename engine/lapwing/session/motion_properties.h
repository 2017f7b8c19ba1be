#pragma once

#include <filesystem>
#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// `mesh` with how its vertices moved from `rest` as vertex properties of doubles: dx, dy, dz the
/// displacement, qw, qx, qy, qz the rotation, stretch (VertexMotion). Properties of these names are
/// replaced, all others stay. `path` is the file that it is for; throws InputError, naming it,
/// unless it is a PLY.
Mesh with_vertex_motion(Mesh mesh, std::span<const Eigen::Vector3d> rest,
                        const std::filesystem::path& path);

}  // namespace lapwing
