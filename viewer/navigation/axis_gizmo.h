#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include "lapwing/render/camera.h"

namespace lapwing::viewer {

/// The axis gizmo shows the directions of the world's axes in a corner of the 3D view. A click on
/// an end of an axis shows the mesh from this direction. Lengths are in points
/// (tools/projection.h).

/// Distance of the ends from the centre of the gizmo, if the axis is parallel to the image.
inline constexpr double kAxisPt = 34.0;
/// Radius of the disk at each end.
inline constexpr double kAxisEndPt = 8.5;
/// Radius of the whole gizmo.
inline constexpr double kAxisGizmoPt = kAxisPt + kAxisEndPt + 3.0;

/// One end of an axis.
struct AxisEnd {
  Eigen::Index axis = 0;  ///< 0 for x, 1 for y, 2 for z
  bool positive = true;
  Eigen::Vector2d offset_pt = Eigen::Vector2d::Zero();  ///< from the centre; y points down
  double toward_eye = 0.0;                              ///< cosine of the angle to the eye
};

/// Returns the six ends, the farthest from the eye first, which is the order to draw them in.
std::array<AxisEnd, 6> axis_ends(const Camera& camera);

/// Of the ends that cover `offset_pt`, measured from the gizmo's centre, returns the one nearest to
/// the eye.
std::optional<AxisEnd> axis_end_at(const Camera& camera, const Eigen::Vector2d& offset_pt);

/// Returns the view that looks at the mesh from this end.
View view_from(const AxisEnd& end, UpAxis up_axis);

}  // namespace lapwing::viewer
