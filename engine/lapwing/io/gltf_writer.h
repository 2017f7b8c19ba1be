#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_patch.h"
#include "lapwing/io/material_transfer.h"
#include "lapwing/io/mesh_file.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Writes each face list in `parts` as primitives, one per material, and adds their data to
/// `appender`. Returns one string per list: the JSON of its primitives, separated by commas.
/// `to_local` maps positions to the coordinates of the glTF mesh. Vertices are split where texture
/// coordinates or normals differ. Corners without a normal get a computed one (computed_normals).
/// Polygons are cut into triangles. Throws InputError if 32-bit floats cannot hold a position.
std::vector<std::string> add_primitives(const Mesh& mesh, std::span<const std::vector<Index>> parts,
                                        const Eigen::Affine3d& to_local, GltfAppender& appender,
                                        double feature_angle_degrees = kFeatureAngleDegrees);

/// Returns a new glTF file that contains only `mesh`, with one node and one mesh for each group.
/// The extension of `target` selects GLB or JSON. With JSON, the result also contains a ".bin" file
/// of the same name and the images of `materials`. If rounding to 32-bit floats would move vertices
/// visibly, for example far from the origin, the nodes get a translation that prevents this.
/// Throws InputError if 32-bit floats cannot hold a position.
std::vector<FileContent> write_gltf(const Mesh& mesh, const std::filesystem::path& target,
                                    const MaterialTransfer& materials, double feature_angle_degrees,
                                    WriteReport& report);

}  // namespace lapwing
