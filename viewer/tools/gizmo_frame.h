#pragma once

#include <Eigen/Geometry>

#include "state/app_state.h"

namespace lapwing::viewer {

/// Along what a gizmo's axes go.
enum class GizmoAxes {
  world,
  local,   ///< the handle's own: x its longest extent, z its shortest; they turn with it
  normal,  ///< z the mean normal of the handle, x across it near the world's x; they turn with it
};

/// What a handle turns about and is scaled from.
enum class GizmoPivot {
  handle,  ///< the middle of its vertices; goes with it
  rim,     ///< the middle of its rim; goes with it
  belt,    ///< the middle of the belt, which stays: a joint
  point,   ///< a place that a person picked
  origin,  ///< the world's
};

/// How a person wants the gizmo to stand. A preference of the view: no part of an edit, of which
/// only the resulting motions are.
struct GizmoChoices {
  GizmoAxes axes = GizmoAxes::world;
  GizmoPivot pivot = GizmoPivot::handle;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of GizmoPivot::point
  bool sticks_to_surface = false;  ///< moved, the middle goes where the cursor is on the surface
};

/// Columns of length 1, perpendicular and right-handed, at the handle that is moved by `motion`.
/// Where the handle has no such axes (a pin, a closed surface) the world's, turned with it.
/// Allocates nothing. Linear in the handle.
Eigen::Matrix3d gizmo_axes(GizmoAxes axes, const AppState& state, std::size_t handle,
                           const Eigen::Affine3d& motion);

/// Where the gizmo stands then. Of a handle without a rim, or without a belt, the middle. Allocates
/// nothing but for a handle with painted weights. Linear in handle and belt.
Eigen::Vector3d gizmo_center(const GizmoChoices& choices, const AppState& state, std::size_t handle,
                             const Eigen::Affine3d& motion);

}  // namespace lapwing::viewer
