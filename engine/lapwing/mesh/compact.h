#pragma once

#include <span>
#include <vector>

#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// The vertices or faces to keep: one entry per element, 0 to drop it.
using KeepMask = std::vector<unsigned char>;

/// Polygons described by what they copy: face f of the result takes the per-face attributes of face
/// `faces[f]`, and its corners copy the corners (entries of `face_vertices`)
/// `corners[starts[f], starts[f+1])` with their vertices, UVs and normals.
struct FaceSources {
  std::vector<Index> faces;
  std::vector<Index> starts{0};
  std::vector<Index> corners;
};

// Every function below but `validate_attributes` carries all of MeshAttributes along, keeps the
// order of what it keeps, and resets `mesh.source`, since the file no longer matches. Linear in the
// size of the mesh. Throws what `validate_attributes` throws, before anything changes.

/// Throws InputError, naming the list, when an attribute list of `mesh` is not of the length that
/// mesh.h states.
void validate_attributes(const Mesh& mesh);

/// Replaces the polygons of `mesh` by those that `sources` describes.
void replace_faces(Mesh& mesh, const FaceSources& sources);

/// Drops the faces whose entry of `keep` is 0. Vertices stay, used or not.
void keep_faces(Mesh& mesh, const KeepMask& keep);

/// Replaces the vertices of `mesh`: new vertex v copies old vertex `sources[v]`. `face_vertices` is
/// not touched; making it name the new vertices is the caller's business.
void replace_vertices(Mesh& mesh, std::span<const Index> sources);

/// Drops the vertices whose entry of `keep` is 0, with the faces that name them, and renumbers.
/// Returns the old number of each new vertex.
std::vector<Index> keep_vertices(Mesh& mesh, const KeepMask& keep);

/// Drops the stored UVs and normals that no corner names, and the materials and groups that no face
/// names, and renumbers what is left in its old order. Normals that are one per vertex stay.
void drop_unused_attributes(Mesh& mesh);

}  // namespace lapwing
