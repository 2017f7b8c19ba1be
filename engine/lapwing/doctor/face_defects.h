#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lapwing/mesh/compact.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Returns whether a polygon has fewer than three corners or uses a vertex twice.
bool is_degenerate(std::span<const Index> polygon);

/// The faces of a mesh without repeated vertices, in the same order.
struct MendedFaces {
  FaceSources sources;
  std::size_t mended = 0;   ///< degenerate faces that were replaced
  std::size_t removed = 0;  ///< degenerate faces that were removed
};

/// Copies non-degenerate faces unchanged. If a face uses a vertex twice in a row, removes the
/// second corner. If the face still repeats a vertex (two outlines joined by a bridge, a pinched
/// polygon), `triangulate_polygon` triangulates it, and degenerate triangles are removed. The cost
/// is linear, except for the triangulation.
MendedFaces mend_faces(const Mesh& mesh);

/// Returns the faces, ascending, that have the same vertices as an earlier face, in any order.
/// Skips faces without corners. Near-linear.
std::vector<Index> find_repeated_faces(const Mesh& mesh);

}  // namespace lapwing
