#pragma once

#include "tools/tool_scene.h"

namespace lapwing::viewer {

/// Whether the surface hides `place`, a point on it that shows at `pixel`. It does if it is nearer
/// to the eye by more than the tip that a pin pulls out. Picks once.
bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector2d& pixel, const ToolScene& scene);

}  // namespace lapwing::viewer
