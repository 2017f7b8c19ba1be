#pragma once

#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses vertices by where they show: under a brush, in a lasso or in a box. Drag with the left
/// button; Control turns painting into erasing and back. [ and ], and scrolling during a stroke,
/// change the brush. Escape gives a stroke up.
class PaintTool final : public SceneTool {
 public:
  enum class Shape { brush, lasso, box };
  struct Options {
    Shape shape = Shape::brush;
    bool through = false;  ///< what the surface hides, too
    bool erase = false;
    double radius_pt = 20.0;  ///< of the brush
  };

  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return dragging_; }
  const char* hint(const AppState& state, const Part& part) const override;
  VertexSet live() const override { return touched_; }
  bool erases() const override { return options_.erase != control_; }
  std::size_t count_with(const VertexSet& chosen) const override;
  ToolMarks marks() const override;
  bool follows_cursor() const override { return options_.shape == Shape::brush; }

  Options& options() { return options_; }

 private:
  void begin(const InputEvent& event, const ToolScene& scene);
  void extend(const Eigen::Vector2d& to, const ToolScene& scene);
  VertexSet seen(VertexSet vertices, const ToolScene& scene) const;
  ToolAnswer finish(const ToolScene& scene);
  void give_up();
  void resize_brush(double steps);
  std::vector<Eigen::Vector2d> outline() const;

  Options options_;
  bool control_ = false;
  bool dragging_ = false;
  std::vector<Eigen::Vector2d> way_;     // of the cursor: all of it for a lasso, else its ends
  std::vector<Eigen::Vector2d> pixels_;  // where the vertices show
  VertexSet touched_;
};

}  // namespace lapwing::viewer
