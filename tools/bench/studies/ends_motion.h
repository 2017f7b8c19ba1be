#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include <Eigen/Geometry>

#include "lapwing/mesh/topology.h"
#include "lapwing/region/edit_region.h"

namespace lapwing::bench {

/// A test motion for a mesh without a chosen region: one end is held, the other moves.
enum class EndsMotion {
  /// Each end is a tenth of the vertices along the longest axis. The upper end moves by a tenth of
  /// the bounding box's diagonal along the next axis (x, y, z, x) and does not turn.
  lift,
  /// Each end is a twentieth of the vertices along y. The upper end moves by a fifth of the
  /// diagonal in x and turns by -30 degrees about z around the mean of its vertices.
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

/// Returns ends of at least three vertices each. Vertices at the same height are ordered by number.
/// Throws InputError if there are fewer than six vertices or one is not finite.
MovedEnds moved_ends(EndsMotion motion, std::span<const Eigen::Vector3d> positions);

/// The part of a mesh that its two ends hold.
struct HeldRegion {
  EditRegion region;         ///< with one handle
  std::size_t left_out = 0;  ///< number of the mesh's other vertices
};

/// Returns the whole mesh without loose vertices and without the components that `check_anchors`
/// refuses: those in which belt and handle hold no three vertices off one line. Throws InputError
/// if no vertex of the belt or none of the handle is left.
HeldRegion held_region(const MovedEnds& ends, std::span<const Eigen::Vector3d> positions,
                       const Topology& topology);

}  // namespace lapwing::bench
