#pragma once

#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses vertices on the screen with a brush, a lasso or a box. Drag with the left button;
/// Control switches between painting and erasing. [ and ], and Control + wheel, resize the brush.
/// Escape cancels a stroke.
class PaintTool final : public SceneTool {
 public:
  enum class Shape { brush, lasso, box };
  struct Options {
    Shape shape = Shape::brush;
    bool through = false;  ///< also chooses hidden vertices
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
  std::vector<Eigen::Vector2d> outline() const;

  Options options_;
  bool control_ = false;
  bool dragging_ = false;
  std::vector<Eigen::Vector2d> way_;     // path of the cursor; only its ends unless it is a lasso
  std::vector<Eigen::Vector2d> pixels_;  // pixels of the vertices
  VertexSet touched_;
};

}  // namespace lapwing::viewer
