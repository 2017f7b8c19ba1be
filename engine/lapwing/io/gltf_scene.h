#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "lapwing/io/gltf_file.h"

namespace lapwing {

/// A node that shows a mesh.
struct GltfObject {
  std::string name;  ///< the node's, else its mesh's, else "node 3"
  std::size_t node = 0;
  std::size_t mesh = 0;
  /// From mesh to world coordinates. The identity for a mesh with a skin, which its joints place:
  /// it is edited in its bind pose.
  Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
  bool has_skin = false;
};

/// Returns the objects called `name` (node or mesh) or, if `name` is empty, those of the scene,
/// parents before children. Of several objects with one mesh, which an edit would move together,
/// only the first is returned; `hidden` counts the others. Throws InputError if no object has that
/// name (the message suggests names), if the nodes do not form trees, or if a transform is not
/// invertible (scale 0).
std::vector<GltfObject> find_objects(const GltfFile& file, const std::string& name,
                                     std::size_t& hidden);

}  // namespace lapwing
