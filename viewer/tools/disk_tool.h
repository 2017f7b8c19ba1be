#pragma once

#include <optional>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses a geodesic disk: press on its centre and drag to its rim, or click. [ and ] and the
/// wheel with Control size the disk chosen last, also where the scene has gone on to another part
/// since. Escape gives up.
class DiskTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return dragging_; }
  const char* hint(const AppState& state, const Part& part) const override;
  /// The vertices in the disk while it is dragged.
  VertexSet live() const override;
  std::size_t count_with(const VertexSet& chosen) const override {
    return dragging_ ? live().size() : chosen.size();
  }
  /// Whether the disk chosen last came by a click, its radius still to be chosen; false while one
  /// is dragged, and before the first.
  bool may_change_choice() const override {
    return center_ != kNoIndex && !dragging_ && !has_moved_;
  }

  double radius() const { return radius_; }

  /// Another surface, or a part chosen by other means: nothing of the last disk counts any more.
  void reset() { *this = {}; }

 private:
  void begin(const SurfacePoint& pick, const InputEvent& event, const ToolScene& scene);
  double radius_at(const Eigen::Vector2d& pixel, const ToolScene& scene) const;
  ToolAnswer chosen() const;
  ToolAnswer resized(double steps);

  bool dragging_ = false;
  bool has_moved_ = false;  // far enough to be no click
  Part part_;               // what it was begun for
  Index center_ = kNoIndex;
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();
  double radius_ = 0.0;
  std::vector<double> distances_;  // from the centre
};

}  // namespace lapwing::viewer
