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
  std::size_t mended = 0;  ///< faces that repeated a vertex and were replaced by their proper parts
  std::size_t removed = 0;  ///< faces that had no proper part
};

/// Copies proper faces as they are. If a face uses a vertex twice in a row, drops the second
/// corner. A face that still returns to a vertex (two outlines joined by a bridge, a pinched
/// polygon) is cut by `triangulate_polygon`, and degenerate triangles are dropped. Linear, except
/// for the cutting.
MendedFaces mend_faces(const Mesh& mesh);

/// Returns the faces, ascending, that have the same vertices as an earlier face, in any order.
/// Skips faces without corners. Near-linear.
std::vector<Index> find_repeated_faces(const Mesh& mesh);

}  // namespace lapwing
