#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Source of a corner's colour. It is the highest byte of a word and defines the other three
/// (shaders/file_color.glsl).
enum class CornerSource : std::uint32_t {
  none = 0,           ///< the surface's own colour
  color = 1U << 24U,  ///< red, green and blue in sRGB, from the lowest byte up
  image = 2U << 24U,  ///< the number of an image
};

/// The colours of a file for the corners of triangles, three for each triangle of the topology.
struct CornerColors {
  std::vector<std::uint32_t> sources;  ///< a CornerSource and its bytes; empty if all are none
  /// Position of a corner in its image, rightwards and downwards, 1 being the whole image. Shifted
  /// by whole images so that a triangle begins near 0. Empty if no corner has an image.
  std::vector<std::array<float, 2>> places;
};

/// Returns, for each triangle corner of `drawn`, its colour in `mesh` or in a file that `mesh`
/// names. Both meshes must have the same polygons, but their vertices may differ, as in a
/// JoinedSurface. Returns an empty result if the numbers of corners differ.
///
/// Each triangle takes its colours from the first available source: an image, vertex colours, its
/// face colour, the colour of its material. An image needs texture coordinates at every corner. The
/// image is not multiplied by the diffuse colour Kd.
CornerColors corner_colors(const Mesh& drawn, const Mesh& mesh, const FileColors& colors);

}  // namespace lapwing
