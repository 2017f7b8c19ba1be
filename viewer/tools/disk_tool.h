#pragma once

#include <optional>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses a geodesic disk: press on its centre and drag to its rim, or click. [ and ] and the
/// wheel with Control size the disk chosen last, also where the scene has gone on to another part
/// since, and so does a drag of one of the grips on its rim. Escape gives up.
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
  /// The grips of the disk chosen last, where that is still what is chosen.
  ToolMarks marks() const override;
  bool follows_cursor() const override { return hover_changed_; }
  /// Whether a press there takes hold of a grip.
  bool is_at_grip(const Eigen::Vector2d& pixel, const ToolScene& scene);

  double radius() const { return radius_; }

  /// Another surface, or a part chosen by other means: nothing of the last disk counts any more.
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
  bool follows_hand_ = false;          // which has moved far enough to be no click
  bool has_moved_ = false;             // the hand, when the disk was chosen
  std::optional<double> size_before_;  // of a disk that a grip sizes
  Part part_;                          // what it was begun for
  Index center_ = kNoIndex;
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d start_ = Eigen::Vector2d::Zero();  // where the centre shows
  double radius_ = 0.0;
  std::vector<double> distances_;  // from the centre
  std::vector<RimGrip> grips_;
  double grips_radius_ = 0.0;
  std::optional<std::size_t> hovered_;  // the grip under the cursor, or dragged
  bool hover_changed_ = false;
};

}  // namespace lapwing::viewer
