#pragma once

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Deforms the surface in one gesture: press on it and pull. The patch under the circle at the
/// cursor becomes the handle, with a falloff, and `grab_region` chooses the region around it. Shift
/// halves the region's radius, and Control doubles it. A press on an existing handle without these
/// keys pulls that handle. [ and ], and Control + wheel, resize the circle.
class GrabTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  ToolMarks marks() const override { return {.brush_pt = radius_pt_}; }
  bool follows_cursor() const override { return true; }

  double radius_pt() const { return radius_pt_; }
  void set_radius_pt(double radius_pt) { radius_pt_ = radius_pt; }

 private:
  double radius_pt_ = 40.0;
};

}  // namespace lapwing::viewer
