#pragma once

#include <string>

#include "lapwing/io/gltf_layout.h"
#include "lapwing/io/gltf_numbers.h"

namespace lapwing {

/// Adds how `mesh`, which `layout` is of, differs from its file as morph target `name`, last of
/// those of each mesh with a vertex that moved: displacements of positions, and of normals where
/// the primitive has them; only of what moved (sparse accessors). The name joins
/// "extras.targetNames", and 0 the weights of meshes, nodes and animations. Throws InputError for a
/// name that is taken, and where nothing moved.
void add_morph_target(const GltfLayout& layout, const Mesh& mesh, const std::string& name,
                      GltfNumbers& numbers, TextEdits& edits);

}  // namespace lapwing
