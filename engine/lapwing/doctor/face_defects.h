#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns whether a polygon has fewer than three corners or uses a vertex twice.
bool is_degenerate(std::span<const Index> polygon);

/// The faces of a mesh without repeated vertices in a face, in the same order.
struct MendedFaces {
  FaceSources sources;
  std::size_t mended = 0;   ///< number of replaced degenerate faces
  std::size_t removed = 0;  ///< number of removed degenerate faces
};

/// Copies non-degenerate faces unchanged. If successive corners of a face have the same vertex,
/// removes the second corner. If the face still repeats a vertex (two outlines joined by a bridge,
/// a pinched polygon), triangulates it by `triangulate_polygon` and removes degenerate triangles.
/// The cost is linear, except for the triangulation.
MendedFaces mend_faces(const Mesh& mesh);

/// Returns the faces, ascending, that have the same vertices as an earlier face, in any order.
/// Skips faces without corners. Near-linear.
std::vector<Index> find_repeated_faces(const Mesh& mesh);

}  // namespace lapwing
