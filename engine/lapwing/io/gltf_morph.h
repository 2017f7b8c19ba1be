#pragma once

#include <span>
#include <string>
#include <vector>

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Adds one of `notes` if objects of `layout` have morph weights other than 0. The mesh is read in
/// its base shape, because morph targets are relative to that.
void note_morph_weights(const GltfLayout& layout, std::vector<std::string>& notes);

/// Adds the differences between `targets` and the file as the last morph targets of each glTF mesh
/// with a moved vertex. Targets have sparse displacements of positions, and of normals if the
/// primitive has them. The names are appended to "extras.targetNames", and zeros to the weights of
/// meshes, nodes and animations. `mesh` has the triangles of the file. Throws InputError if a name
/// is taken or nothing moved.
void add_morph_targets(const GltfLayout& layout, const Mesh& mesh,
                       std::span<const MorphTarget> targets, GltfNumbers& numbers,
                       TextEdits& edits);

}  // namespace lapwing
