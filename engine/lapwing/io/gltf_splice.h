#pragma once

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Replaces the triangles of the objects that an edit has changed. The new primitives, one per
/// material, go behind all other data. Faces belong to the object of their group's name (see
/// read_gltf), others to the first. `report` lists what the new triangles do not have. Throws
/// InputError if an object has morph targets or no triangle left.
void replace_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                       TextEdits& edits, WriteReport& report);

}  // namespace lapwing
