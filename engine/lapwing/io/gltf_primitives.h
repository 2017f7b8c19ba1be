#pragma once

#include <span>
#include <string>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_appender.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The faces `faces` of `mesh` as primitives, one for each material, with the vertices that
/// `to_local` puts into the mesh's own coordinates: their JSON, separated by commas, and in
/// `appender` their data. Vertices are split where texture coordinates or normals differ; corners
/// without a normal get the mean of the faces at their vertex, by area. Polygons are cut into
/// triangles. Material k of the mesh is `first_material` + k of the document.
std::string add_primitives(const Mesh& mesh, std::span<const Index> faces,
                           const Eigen::Affine3d& to_local, std::size_t first_material,
                           GltfAppender& appender);

}  // namespace lapwing
