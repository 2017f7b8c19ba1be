#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lapwing/io/file_colors.h"
#include "lapwing/mesh/mesh.h"

namespace lapwing {

/// Source of a corner's colour: the highest byte of a 32-bit word. It defines the meaning of the
/// three lower bytes (shaders/file_color.glsl).
enum class CornerSource : std::uint32_t {
  none = 0,           ///< the surface's own colour
  color = 1U << 24U,  ///< red, green and blue in sRGB, from the lowest byte up
  image = 2U << 24U,  ///< the index of a texture image
};

/// The colours of a file for the corners of all triangles.
struct CornerColors {
  std::vector<std::uint32_t> sources;  ///< one word per corner; empty if all are `none`
  /// Position of each corner in its texture image, from the left and from the top; 1 is the whole
  /// image. Shifted by integers so that the first corner of a triangle is near 0. Empty if no
  /// corner has an image.
  std::vector<std::array<float, 2>> places;
};

/// Returns the colour of each triangle corner of `drawn` in `mesh` or in a file that `mesh` names.
/// Both meshes must have the same polygons, but their vertices may differ, as in a JoinedSurface.
/// If their numbers of corners differ, the result is empty.
///
/// The colour of a triangle comes from the first available source: an image with texture
/// coordinates at every corner, vertex colours, the face colour, the diffuse colour Kd of the
/// material. The image is not multiplied by Kd.
CornerColors corner_colors(const Mesh& drawn, const Mesh& mesh, const FileColors& colors);

}  // namespace lapwing
