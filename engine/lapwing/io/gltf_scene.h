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
  /// From the mesh's coordinates to the world's. The identity for a mesh with a skin, which its
  /// joints place: it is edited as it was bound to them.
  Eigen::Affine3d to_world = Eigen::Affine3d::Identity();
  bool has_skin = false;
};

/// The objects of a file, parents before children: those called `name` (node or mesh); without a
/// name those of its scene. Of several that show one mesh, which an edit would move together, the
/// first; `hidden` counts the others. Throws InputError when there is none of that name, with the
/// names that there are, and for nodes that no tree holds or that cannot be undone (scale 0).
std::vector<GltfObject> find_objects(const GltfFile& file, const std::string& name,
                                     std::size_t& hidden);

}  // namespace lapwing
