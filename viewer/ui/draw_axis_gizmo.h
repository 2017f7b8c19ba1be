#pragma once

#include <Eigen/Core>

#include "lapwing/render/camera.h"

namespace lapwing::viewer {

/// Draws the axis gizmo (navigation/axis_gizmo.h) under the panels. `center` and `units_per_point`
/// are in ImGui's units.
void draw_axis_gizmo(const Camera& camera, const Eigen::Vector2d& center, double units_per_point);

}  // namespace lapwing::viewer
