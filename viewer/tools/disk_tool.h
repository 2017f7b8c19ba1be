#pragma once

#include <optional>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses a geodesic disk: press on its centre and drag to its rim, or click. [ and ], Control +
/// wheel, and the grips on its rim resize the last disk, even after the scene has gone on to
/// another part. Escape cancels a drag.
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
  /// Whether the last disk was clicked, so that its radius is still to be chosen. False during a
  /// drag and before the first disk.
  bool may_change_choice() const override {
    return center_ != kNoIndex && !dragging_ && !has_moved_;
  }
  /// The grips of the last disk, if it is still chosen.
  ToolMarks marks() const override;
  bool follows_cursor() const override { return hover_changed_; }
  /// Whether a press at `pixel` would start to drag a grip.
  bool is_at_grip(const Eigen::Vector2d& pixel, const ToolScene& scene);

  double radius() const { return radius_; }

  /// Forgets the last disk, because the surface has changed or a part was chosen by other means.
  void reset() { *this = {}; }

 private:
  void begin(const SurfacePoint& pick, const InputEvent& event, const ToolScene& scene);
  double radius_at(const Eigen::Vector2d& pixel, const ToolScene& scene) const;
  ToolAnswer drag(const InputEvent& event, const ToolScene& scene);
  void give_up();
  void take_grip(const InputEvent& event, const ToolScene& scene);
  void renew_grips(const ToolScene& scene);
  std::optional<std::size_t> grip_at_cursor(const Eigen::Vector2d& pixel,
                                            const ToolScene& scene) const;
  bool is_chosen(const EditSelection& selection) const;
  ToolAnswer chosen() const;
  ToolAnswer resized(double steps);

  bool dragging_ = false;
  bool follows_hand_ = false;          // the cursor has moved farther than in a click
  bool has_moved_ = false;             // the last disk was dragged, not clicked
  std::optional<double> size_before_;  // radius before the drag of a grip
  Part part_;                          // the part that the disk chooses
  Index center_ = kNoIndex;
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();  // pixel of the centre
  double radius_ = 0.0;
  std::vector<double> distances_;  // geodesic, from the centre
  std::vector<RimGrip> grips_;
  double grips_radius_ = 0.0;
  std::optional<std::size_t> hovered_;  // the grip under the cursor, or dragged
  bool hover_changed_ = false;
};

}  // namespace lapwing::viewer
