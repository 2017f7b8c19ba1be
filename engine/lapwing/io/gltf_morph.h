#pragma once

#include <string>
#include <vector>

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_scene.h"

namespace lapwing {

/// Adds one of `notes` if objects of `layout` have morph weights other than 0. The mesh is read in
/// its base shape, because morph targets are relative to that.
void note_morph_weights(const GltfLayout& layout, std::vector<std::string>& notes);

/// Adds the difference between `mesh` and its file as morph target `name`, the last one of each
/// glTF mesh with a moved vertex. The target has sparse displacements of positions, and of normals
/// if the primitive has them. The name is appended to "extras.targetNames", and 0 to the weights of
/// meshes, nodes and animations. Throws InputError if the name is taken or nothing moved.
void add_morph_target(const GltfLayout& layout, const Mesh& mesh, const std::string& name,
                      GltfNumbers& numbers, TextEdits& edits);

}  // namespace lapwing
