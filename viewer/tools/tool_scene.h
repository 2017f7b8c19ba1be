#pragma once

#include <functional>
#include <optional>
#include <span>

#include "state/command.h"
#include "tools/projection.h"

namespace lapwing::viewer {

/// Decides what R does: it turns in Blender and scales in Maya. All other keys of both always work.
enum class GizmoKeys { blender, maya };

/// The scene that a tool works on.
struct ToolScene {
  const AppState& state;
  std::span<const Eigen::Vector3d> positions;  ///< of the visible surface
  const Projection& projection;
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick = {};
  /// Whether the surface does not hide a vertex (SeenVertices). If empty, all are visible.
  std::function<bool(Index vertex)> is_visible = {};
  Part part = {};          ///< what is being chosen
  std::size_t handle = 0;  ///< index of the handle to move
  GizmoKeys keys = GizmoKeys::blender;
  /// Picks like `pick`, but only the part of the surface that the edit leaves in place.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d& pixel)> pick_still = {};
};

}  // namespace lapwing::viewer
