#pragma once

#include <optional>
#include <vector>

#include "tools/input.h"
#include "tools/select_scene.h"
#include "tools/tool_answer.h"

namespace lapwing::viewer {

/// Chooses a geodesic disk: press on its centre and drag to its rim, or click and scroll. Scrolling
/// changes the disk chosen last, too, also where the scene has gone on to another part since.
/// Escape gives up.
class DiskTool {
 public:
  ToolAnswer handle(const InputEvent& event, const SelectScene& scene);

  bool is_dragging() const { return dragging_; }
  /// The vertices in the disk while it is dragged.
  VertexSet live() const;
  double radius() const { return radius_; }
  /// Whether the disk chosen last came by a click, its radius still to be scrolled; false while one
  /// is dragged, and before the first.
  bool was_clicked() const { return center_ != kNoIndex && !dragging_ && !has_moved_; }

  /// Another surface, or a part chosen by other means: nothing of the last disk counts any more.
  void reset() { *this = {}; }

 private:
  void begin(const SurfacePoint& pick, const InputEvent& event, const SelectScene& scene);
  double radius_at(const Eigen::Vector2d& pixel, const SelectScene& scene) const;
  ToolAnswer chosen() const;

  bool dragging_ = false;
  bool has_moved_ = false;  // far enough to be no click
  Part part_;               // what it was begun for
  Index center_ = kNoIndex;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double radius_ = 0.0;
  std::vector<double> distances_;  // from the centre
};

}  // namespace lapwing::viewer
