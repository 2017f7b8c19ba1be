#pragma once

#include <vector>

#include "tools/input.h"
#include "tools/select_scene.h"
#include "tools/tool_answer.h"

namespace lapwing::viewer {

/// Chooses vertices by where they show: under a brush, in a lasso or in a box. Drag with the left
/// button; Control turns painting into erasing and back. [ and ], and scrolling during a stroke,
/// change the brush. Escape gives a stroke up.
class PaintTool {
 public:
  enum class Shape { brush, lasso, box };
  struct Options {
    Shape shape = Shape::brush;
    bool through = false;  ///< what the surface hides, too
    bool erase = false;
    double radius = 20.0;  ///< of the brush, in pixels
  };

  ToolAnswer handle(const InputEvent& event, const SelectScene& scene);

  Options& options() { return options_; }
  const Options& options() const { return options_; }
  bool is_dragging() const { return dragging_; }
  bool erases() const { return options_.erase != control_; }
  /// The vertices of the stroke so far.
  const VertexSet& live() const { return touched_; }
  /// What to draw of a lasso or box: a closed line, in pixels.
  std::vector<Eigen::Vector2d> outline() const;

 private:
  void begin(const InputEvent& event, const SelectScene& scene);
  void extend(const Eigen::Vector2d& to, const SelectScene& scene);
  VertexSet seen(VertexSet vertices, const SelectScene& scene) const;
  ToolAnswer finish(const SelectScene& scene);
  void give_up();
  void resize_brush(double steps);

  Options options_;
  bool control_ = false;
  bool dragging_ = false;
  std::vector<Eigen::Vector2d> way_;     // of the cursor: all of it for a lasso, else its ends
  std::vector<Eigen::Vector2d> pixels_;  // where the vertices show
  VertexSet touched_;
};

}  // namespace lapwing::viewer
