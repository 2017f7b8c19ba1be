#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// What colours a corner of a triangle. The highest byte says what the other three are;
/// shaders/file_color.glsl.
enum class CornerSource : std::uint32_t {
  none = 0,           ///< nothing: the surface has its own colour there
  color = 1U << 24U,  ///< red, green and blue in sRGB, from the lowest byte up
  image = 2U << 24U,  ///< the number of an image
};

/// The colours of a file for the corners of triangles, three for each triangle of the topology.
struct CornerColors {
  std::vector<std::uint32_t> sources;  ///< a CornerSource with what it says; empty if all are none
  /// Where in its image a corner lies: to the right and downwards, 1 being all of it, moved by
  /// whole images so that a triangle begins near 0. Empty if no corner has an image.
  std::vector<std::array<float, 2>> places;
};

/// What `mesh` and the colours of its file give each corner. One thing colours a triangle, the
/// first that it has: an image and a place in it at every corner, colours of vertices, the colour
/// of its face, the colour of its material. An image stands for itself: Kd does not darken it.
CornerColors corner_colors(const Mesh& mesh, const FileColors& colors);
/// The same for `drawn`, whose polygons have the corners of those of `mesh` but name other
/// vertices, as where seams are joined (JoinedSurface); nothing where they have not.
CornerColors corner_colors(const Mesh& drawn, const Mesh& mesh, const FileColors& colors);

}  // namespace lapwing
