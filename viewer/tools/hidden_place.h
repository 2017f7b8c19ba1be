#pragma once

#include "tools/tool_scene.h"

namespace lapwing::viewer {

/// Whether the surface stands before a place on it that shows at `pixel`: it is nearer to the eye
/// there by more than the tip that a pin draws out. Picks once.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector2d& pixel, const ToolScene& scene);

}  // namespace lapwing::viewer
