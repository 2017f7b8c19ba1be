#pragma once

#include <optional>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Returns at most eight grips on the rim of the geodesic disk, in evenly spaced directions.
/// `distances` has one entry per vertex, its distance from the vertex `center`. The entries of
/// unreachable vertices are infinite.
std::vector<RimGrip> rim_grips(const Topology& topology, std::span<const Eigen::Vector3d> positions,
                               std::span<const double> distances, Index center, double radius);

/// Selects a geodesic disk. Press on its centre and drag to its rim, or click. The keys [ and ],
/// Control + wheel, and the grips on its rim resize the last disk. This remains possible while the
/// user chooses the next part. Escape cancels a drag.
class DiskTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  bool is_dragging() const override { return dragging_; }
  const char* hint(const AppState& state, const Part& part) const override;
  VertexSet live() const override;
  std::size_t count_with(const VertexSet& chosen) const override {
    return dragging_ ? live().size() : chosen.size();
  }
  /// Returns true if the last disk was made by a click, so that the user may still set its radius.
  bool may_change_choice() const override {
    return center_ != kNoIndex && !dragging_ && !has_moved_;
  }
  /// Returns the grips of the last disk, or none if it is no longer the chosen region.
  ToolMarks marks() const override;
  bool follows_cursor() const override { return hover_changed_; }
  /// Returns whether a press at `pixel` would start a drag of a grip.
  bool is_at_grip(const Eigen::Vector2d& pixel, const ToolScene& scene);

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
  ToolAnswer chosen(bool resizes) const;
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
