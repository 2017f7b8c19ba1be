#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_appender.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Writes the faces `faces` of `mesh` as primitives, one per material. Returns their JSON,
/// separated by commas, and adds their data to `appender`. `to_local` maps positions to the
/// coordinates of the glTF mesh. Vertices are split where texture coordinates or normals differ.
/// Corners without a normal get the area-weighted mean of the faces at their vertex. Polygons are
/// cut into triangles. Material k of the mesh is `first_material` + k of the document. Throws
/// InputError if 32-bit floats cannot hold a position.
std::string add_primitives(const Mesh& mesh, std::span<const Index> faces,
                           const Eigen::Affine3d& to_local, std::size_t first_material,
                           GltfAppender& appender);

}  // namespace lapwing
