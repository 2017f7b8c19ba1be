#pragma once

#include <array>
#include <span>
#include <string_view>

#include <Eigen/Geometry>

#include "lapwing/region/vertex_set.h"

namespace lapwing::bench {

/// What is done to a mesh that nobody has chosen a region of: one end is held, the other is moved.
enum class EndsMotion {
  /// The tenths of the vertices at both ends of the longest axis; the upper end is moved by a tenth
  /// of the bounding box's diagonal along the next axis (x, y, z, x), and not turned.
  lift,
  /// The twentieths at both ends of y; the upper end is moved by a fifth of the diagonal in x and
  /// turned by -30 degrees about z around the mean of its vertices.
  lean,
};
inline constexpr std::array kEndsMotions{EndsMotion::lift, EndsMotion::lean};

std::string_view name_of(EndsMotion motion);

/// The two ends, and the map of space that acts on the handle's rest positions.
struct MovedEnds {
  VertexSet belt;
  VertexSet handle;
  Eigen::Affine3d map = Eigen::Affine3d::Identity();
};

/// At least three vertices at each end; of vertices at the same height, those of lower number are
/// lower. Throws InputError when there are fewer than six vertices or one is not finite.
MovedEnds moved_ends(EndsMotion motion, std::span<const Eigen::Vector3d> positions);

}  // namespace lapwing::bench
