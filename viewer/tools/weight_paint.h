#pragma once

#include <vector>

#include "tools/paint_tool.h"
#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Paints a number from 0 to 1 on every vertex, the share of the second source. The brush sets what
/// it touches to `strength`, or to 0 with Ctrl.
class WeightPaint final : public SceneTool {
 public:
  WeightPaint();

  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return paint_.is_dragging(); }
  const char* hint(const AppState&, const Part&) const override {
    return "Paint where the second source appears. Ctrl erases.";
  }
  ToolMarks marks() const override { return paint_.marks(); }

  /// One number per vertex. `handle` resizes it to one entry per vertex of the scene; new entries
  /// are 0.
  const std::vector<double>& field() const { return field_; }
  void set_field(std::vector<double> field) { field_ = std::move(field); }
  /// The field as it would be if the stroke ended here.
  std::vector<double> live_field() const;
  /// Averages every number with those of the adjacent vertices.
  void soften(const Topology& topology);

  double strength = 1.0;
  PaintTool::Options& brush() { return paint_.options(); }

 private:
  PaintTool paint_;
  std::vector<double> field_;
};

}  // namespace lapwing::viewer
