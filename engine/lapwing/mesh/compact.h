#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The vertices or faces to keep: one entry per element, 0 to drop it.
using KeepMask = std::vector<unsigned char>;

/// New polygons as copies of old ones. Face f copies the per-face attributes of face `faces[f]`.
/// Its corners copy the corners (entries of `face_vertices`) `corners[starts[f], starts[f+1])` with
/// their vertices, UVs and normals.
struct FaceSources {
  std::vector<Index> faces;
  std::vector<Index> starts{0};
  std::vector<Index> corners;
};

// Every function below except `validate_attributes` updates all of MeshAttributes, keeps the order
// of the remaining elements, and resets `mesh.source`, because the file no longer matches. The cost
// is linear in the size of the mesh. They throw what `validate_attributes` throws, before they
// change anything.

/// Throws InputError, naming the list, if an attribute list does not have the length stated in
/// mesh.h.
void validate_attributes(const Mesh& mesh);

/// Replaces the polygons of `mesh` by those that `sources` describes.
void replace_faces(Mesh& mesh, const FaceSources& sources);

/// Drops the faces whose entry of `keep` is 0. Vertices stay, used or not.
void keep_faces(Mesh& mesh, const KeepMask& keep);

/// Replaces the vertices of `mesh`: new vertex v copies old vertex `sources[v]`. The caller must
/// renumber `face_vertices`.
void replace_vertices(Mesh& mesh, std::span<const Index> sources);

/// Drops the vertices whose entry of `keep` is 0 and the faces that use them, and renumbers the
/// rest. Returns the old number of each new vertex.
std::vector<Index> keep_vertices(Mesh& mesh, const KeepMask& keep);

/// Replaces the polygons by the triangles of `mesh.topology()`, with their attributes. Degenerate
/// faces are dropped. Does nothing if all faces are triangles already.
void triangulate_faces(Mesh& mesh);

/// Drops the stored normals.
void drop_normals(Mesh& mesh);

/// Drops UVs and normals that no corner uses, and materials and groups that no face uses. Renumbers
/// the rest in the old order. Per-vertex normals stay.
void drop_unused_attributes(Mesh& mesh);

}  // namespace lapwing
