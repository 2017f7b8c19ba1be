#pragma once

#include "tools/surface_brush.h"

namespace lapwing::viewer {

/// Paints the stiffness of the surface. The brush sets the stiffness factor of the vertices that it
/// touches. With Ctrl, it resets the factor to 1.
class StiffnessPaint final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return brush_.tool().is_dragging(); }
  const char* hint(const AppState&, const Part&) const override {
    return "Paint rigid, stiff or soft parts. Ctrl erases.";
  }
  ToolMarks marks() const override { return brush_.tool().marks(); }
  bool follows_cursor() const override { return true; }

  /// The factor that the brush paints.
  double painted_factor() const { return is_rigid ? kRigidStiffness : factor; }
  /// Returns the stiffness as it would be if the stroke ended here.
  std::vector<StiffnessSpec> live_stiffness(const AppState& state) const;

  bool is_rigid = true;
  double factor = 10.0;
  PaintTool::Options& brush() { return brush_.options(); }

 private:
  SurfaceBrush brush_;
};

}  // namespace lapwing::viewer
