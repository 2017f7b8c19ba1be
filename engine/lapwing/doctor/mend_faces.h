#pragma once

#include <cstddef>
#include <span>

#include "lapwing/mesh/compact.h"

namespace lapwing {

/// Whether a polygon has fewer than three corners or names a vertex twice.
bool is_degenerate(std::span<const Index> polygon);

/// Faces without repeated vertices, from those of a mesh, in the same order.
struct MendedFaces {
  FaceSources sources;
  std::size_t mended = 0;  ///< faces that repeated a vertex and were replaced by their proper parts
  std::size_t removed = 0;  ///< faces that had no proper part
};

/// Copies proper faces as they are. Where a face names a vertex twice in a row, the second corner
/// goes; a face that still comes back to a vertex (two outlines joined by a bridge, a pinched
/// polygon) is cut into the triangles that `triangulate_polygon` gives, less those without extent.
/// Linear, but for the cutting.
MendedFaces mend_faces(const Mesh& mesh);

}  // namespace lapwing
