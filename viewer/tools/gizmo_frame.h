#pragma once

#include <Eigen/Geometry>

#include "state/app_state.h"

namespace lapwing::viewer {

/// Orientation of a gizmo's axes.
enum class GizmoAxes {
  world,
  local,   ///< principal axes of the handle, x its longest extent, z its shortest; turn with it
  normal,  ///< z is the mean normal of the handle, x is close to the world's x; turn with it
};

/// The point about which a handle turns and scales.
enum class GizmoPivot {
  handle,  ///< centroid of the handle; moves with it
  rim,     ///< centroid of its rim; moves with it
  belt,    ///< centroid of the belt, which does not move: a joint
  point,   ///< a point that the user has picked
  origin,  ///< the world's origin
};

/// Preferences for the gizmo. They are not part of an edit, which records only the resulting
/// motions.
struct GizmoChoices {
  GizmoAxes axes = GizmoAxes::world;
  GizmoPivot pivot = GizmoPivot::handle;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< for GizmoPivot::point
  bool sticks_to_surface = false;  ///< a moved handle follows the surface under the cursor
};

/// Returns the axes for a handle moved by `motion` as perpendicular unit columns, right-handed. A
/// handle without such axes (a pin, a closed surface) gets the world's, turned with it. Allocates
/// nothing. Linear in the handle.
Eigen::Matrix3d gizmo_axes(GizmoAxes axes, const AppState& state, std::size_t handle,
                           const Eigen::Affine3d& motion);

/// Returns the centre for that handle; its centroid if the handle has no rim, or the edit no belt.
/// Allocates only for a handle with painted weights. Linear in handle and belt.
Eigen::Vector3d gizmo_center(const GizmoChoices& choices, const AppState& state, std::size_t handle,
                             const Eigen::Affine3d& motion);

}  // namespace lapwing::viewer
