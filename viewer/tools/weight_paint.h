#pragma once

#include <vector>

#include "tools/surface_brush.h"

namespace lapwing::viewer {

/// Paints a number from 0 to 1 on every vertex, the share of the second source. The brush sets what
/// it touches to `strength`, or to 0 with Ctrl.
class WeightPaint final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return brush_.tool().is_dragging(); }
  const char* hint(const AppState&, const Part&) const override {
    return "Paint where the second source should appear. Ctrl erases.";
  }
  ToolMarks marks() const override { return brush_.tool().marks(); }

  /// One number per vertex. `handle` resizes it to one entry per vertex of the scene; new entries
  /// are 0.
  const std::vector<double>& field() const { return field_; }
  void set_field(std::vector<double> field) { field_ = std::move(field); }
  /// The field as it would be if the stroke ended here.
  std::vector<double> live_field() const;
  /// Averages every number with those of the adjacent vertices.
  void soften(const Topology& topology);

  double strength = 1.0;
  PaintTool::Options& brush() { return brush_.options(); }

 private:
  SurfaceBrush brush_;
  std::vector<double> field_;
};

}  // namespace lapwing::viewer
