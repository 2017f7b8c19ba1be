#pragma once

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Whether a handle is a pin: a single vertex.
bool is_pin(const ChosenRegion& handle);

/// Pins single vertices and drags them in the view plane. A press on the surface pins the vertex
/// there; a press on a pin selects it. With Shift, nothing is dragged. If there is no ROI, the
/// whole mesh becomes the ROI.
class PinTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  /// Always true, because more pins may follow.
  bool may_change_choice() const override { return true; }
};

/// Returns the handle that is the nearest visible pin within a few points of `pixel`, if any.
std::optional<std::size_t> pin_at(const Eigen::Vector2d& pixel, const ToolScene& scene);

}  // namespace lapwing::viewer
