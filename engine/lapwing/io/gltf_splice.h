#pragma once

#include "lapwing/io/gltf_edits.h"
#include "lapwing/io/gltf_scene.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Replaces the triangles of the objects that an edit has changed. Appends one new primitive per
/// material after all other data. A face belongs to the object with the name of the face's group
/// (see read_gltf). If there is no such object, it belongs to the first object. `report` lists the
/// attributes that the new triangles lack. Throws InputError if an object has morph targets or no
/// triangle left.
void replace_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                       TextEdits& edits, WriteReport& report);

}  // namespace lapwing
