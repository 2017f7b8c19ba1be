#pragma once

#include <string>
#include <vector>

#include "lapwing/io/gltf_scene.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The objects that show one mesh of a glTF file, after an edit that moved one of them or more.
struct MovedInstances {
  std::vector<std::size_t> objects;  ///< into GltfLayout::objects: all that show the mesh
  std::vector<std::size_t> moved;    ///< those with a moved vertex
  /// Whether the moved objects have equal positions in the coordinates of the mesh, up to rounding.
  bool are_alike = true;
};

/// Returns the moved meshes of `layout`, with the objects that show each.
std::vector<MovedInstances> moved_instances(const GltfLayout& layout, const Mesh& mesh);

/// Returns the names of the objects of the file, read or not, that show the mesh of `edited` and
/// are not among them.
std::vector<std::string> others_showing(const GltfLayout& layout,
                                        const std::vector<std::size_t>& edited);

/// Returns the names of the objects for a message: "'Left', 'Right' and 'Top'", at most five.
std::string names_of(const GltfLayout& layout, const std::vector<std::size_t>& objects);

/// Notes to the user: the edit of some objects appears in others that show their mesh, or objects
/// that showed one mesh do not any more.
std::string note_of_shared_edit(const GltfLayout& layout, const std::vector<std::size_t>& edited,
                                const std::vector<std::string>& others);
std::string note_of_separation(const GltfLayout& layout, const std::vector<std::size_t>& edited);

}  // namespace lapwing
