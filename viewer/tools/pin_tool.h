#pragma once

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Whether a handle is a pin: a single vertex.
bool is_pin(const ChosenRegion& handle);

/// Pins single vertices, and drags them: a press on the surface pins the vertex there, one on a pin
/// takes hold of it, and either is dragged in the plane of the view from there. With shift it is
/// only pinned, or chosen. Without an ROI the whole mesh becomes it.
class PinTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  /// More pins may follow.
  bool may_change_choice() const override { return true; }
};

/// The pin that shows within a few points of `pixel`, the nearest; none where none does.
std::optional<std::size_t> pin_at(const Eigen::Vector2d& pixel, const ToolScene& scene);

}  // namespace lapwing::viewer
