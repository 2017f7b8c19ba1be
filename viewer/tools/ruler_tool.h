#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Measures between two vertices: click both, or drag from one to the other. The measure stays when
/// the tool changes, and follows the surface. Another click starts a new one, Escape removes it.
class RulerTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  ToolMarks marks() const override;

  bool is_begun() const { return from_ != kNoIndex; }
  bool has_both_ends() const { return to_ != kNoIndex; }
  /// Updates the distances for the surface at `positions`. `still` is false while the surface
  /// moves. Removes the measurement if its end points are not vertices of `topology`.
  void follow(const std::shared_ptr<const Topology>& topology,
              std::span<const Eigen::Vector3d> positions, bool still);

  double straight() const { return straight_; }
  /// The geodesic distance. While the surface moves, it is scaled with the length of the edge path.
  double along() const { return along_; }
  /// The positions of the shortest edge path.
  std::span<const Eigen::Vector3d> line() const { return line_; }
  /// Writes "straight 1.2, along the surface 1.5".
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
  std::vector<Eigen::Vector3d> line_;  // positions of path_
  double straight_ = 0.0;
  double along_ = 0.0;
  double measured_along_ = 0.0;   // along_ when the surface last stood still
  double measured_length_ = 0.0;  // length of line_ at that time
};

}  // namespace lapwing::viewer
