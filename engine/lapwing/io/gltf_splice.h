#pragma once

#include "lapwing/io/gltf_layout.h"
#include "lapwing/io/gltf_numbers.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Replaces the triangles of the objects in `layout` that an edit has changed. The new primitives,
/// one per material, go behind all other data. Faces belong to the object of their group (see
/// read_gltf), others to the first. The rest of the document stays. `report` lists what the new
/// triangles do not have (skin, tangents, further attributes); their nodes lose the skin. Throws
/// InputError if an object has no triangle left, or has morph targets, which belong to its old
/// triangles.
void splice_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                      TextEdits& edits, WriteReport& report);

}  // namespace lapwing
