#pragma once

#include <functional>
#include <optional>
#include <span>

#include "state/command.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// What R does: it turns in Blender and scales in Maya. All other keys of both always work.
enum class GizmoKeys { blender, maya };

/// What a tool works on.
struct ToolScene {
  const AppState& state;
  std::span<const Eigen::Vector3d> positions;  ///< of the surface that is seen
  const Projection& projection;
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick = {};
  /// Whether a vertex is seen, not hidden by the surface; without it all are
  /// (SeenVertices tells).
  std::function<bool(Index vertex)> is_visible = {};
  Part part = {};          ///< what is being chosen
  std::size_t handle = 0;  ///< of the state, which is moved
  GizmoKeys keys = GizmoKeys::blender;
  /// What shows at a pixel of the surface that the edit leaves where it is.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick_still = {};
};

}  // namespace lapwing::viewer
