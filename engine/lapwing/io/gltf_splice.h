#pragma once

#include "lapwing/io/gltf_layout.h"
#include "lapwing/io/gltf_numbers.h"
#include "lapwing/io/mesh_file.h"

namespace lapwing {

/// Puts the triangles of `mesh` in the place of those of the objects that `layout` is of, where a
/// step has changed them: new primitives, one for each material, behind all other data. Faces
/// belong to the object whose group they are in (see read_gltf), others to the first. All else of
/// the document stays; what an object's new triangles have no place for (its skin, tangents,
/// further attributes) is told in `report`, and its node loses the skin. Throws InputError for an
/// object with morph targets, which belong to its old triangles.
void splice_triangles(const GltfLayout& layout, const Mesh& mesh, GltfNumbers& numbers,
                      TextEdits& edits, WriteReport& report);

}  // namespace lapwing
