#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Measures between two vertices: click one and then the other, or drag from one to the other. What
/// it measures stays, whatever tool is in hand, and goes with the surface; another click begins
/// anew, Escape removes it.
class RulerTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  ToolMarks marks() const override;

  bool is_begun() const { return from_ != kNoIndex; }
  bool has_both_ends() const { return to_ != kNoIndex; }
  /// Measures anew where the surface has moved: it stands `still` at `positions`, or is being moved
  /// there. The ends are numbers of `topology`; for any other one the ruler is removed.
  void follow(const std::shared_ptr<const Topology>& topology,
              std::span<const Eigen::Vector3d> positions, bool still);

  double straight() const { return straight_; }
  /// The geodesic distance; while the surface moves about that, by how the way grows.
  double along() const { return along_; }
  /// The shortest way along edges, as it shows.
  std::span<const Eigen::Vector3d> line() const { return line_; }
  /// "straight 1.2, along the surface 1.5"
  void read_out(std::string& text) const;

  void reset() { *this = {}; }

 private:
  ToolAnswer begin(const InputEvent& event, const ToolScene& scene);
  ToolAnswer end(Index vertex, const ToolScene& scene);
  void measure_along_path(const Topology& topology, std::span<const Eigen::Vector3d> positions);

  std::shared_ptr<const Topology> topology_;
  Index from_ = kNoIndex;
  Index to_ = kNoIndex;
  Eigen::Vector2d pressed_ = Eigen::Vector2d::Zero();
  bool is_pressed_ = false;
  std::vector<Index> path_;
  std::vector<Eigen::Vector3d> line_;  // through the path
  double straight_ = 0.0;
  double along_ = 0.0;
  double measured_along_ = 0.0;   // when the surface stood still last,
  double measured_length_ = 0.0;  // and the length of the line then
};

}  // namespace lapwing::viewer
