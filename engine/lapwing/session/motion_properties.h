#pragma once

#include <filesystem>
#include <span>

#include <Eigen/Core>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns `mesh` with the motion of its vertices from `rest` as vertex properties of doubles:
/// displacement dx, dy, dz, rotation qw, qx, qy, qz, and stretch (VertexMotion). Replaces existing
/// properties of these names and keeps all others. Throws InputError, naming `path`, the output
/// file, unless it is a PLY.
Mesh with_vertex_motion(Mesh mesh, std::span<const Eigen::Vector3d> rest,
                        const std::filesystem::path& path);

}  // namespace lapwing
