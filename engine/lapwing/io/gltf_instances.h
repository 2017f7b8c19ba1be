#pragma once

#include <string>
#include <vector>

#include "lapwing/io/gltf_scene.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The objects that show one mesh of a glTF file, after an edit that moved at least one of them.
struct MovedInstances {
  std::vector<std::size_t> objects;  ///< all that show the mesh; indices into GltfLayout::objects
  std::vector<std::size_t> moved;    ///< those of `objects` that have a moved vertex
  /// Whether all moved objects have equal positions in mesh coordinates, up to rounding.
  bool are_alike = true;
};

/// Returns one entry for each mesh that is shown by at least one object with a moved vertex.
std::vector<MovedInstances> moved_instances(const GltfLayout& layout, const Mesh& mesh);

/// Returns the names of all other objects that show the mesh of `edited`, even of objects that
/// the reader did not read.
std::vector<std::string> others_showing(const GltfLayout& layout,
                                        const std::vector<std::size_t>& edited);

/// Throws InputError if `object` is an instance of a node (EXT_mesh_gpu_instancing), which cannot
/// get its own mesh.
void require_own_node(const GltfObject& object);

/// Returns the names of the objects for a message, such as "'Left', 'Right' and 'Top'". Lists at
/// most five.
std::string names_of(const GltfLayout& layout, const std::vector<std::size_t>& objects);

/// These functions return notes to the user. The first says that the edit also appears in `others`,
/// which show the same mesh. The second says that the edited objects no longer share one mesh.
std::string note_of_shared_edit(const GltfLayout& layout, const std::vector<std::size_t>& edited,
                                const std::vector<std::string>& others);
std::string note_of_separation(const GltfLayout& layout, const std::vector<std::size_t>& edited);

}  // namespace lapwing
