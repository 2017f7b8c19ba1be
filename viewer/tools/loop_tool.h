#pragma once

#include <vector>

#include "tools/scene_tool.h"

namespace lapwing::viewer {

/// Chooses one side of a closed loop. Clicks are joined along mesh edges. A click on the first one,
/// or Enter, closes the loop, and the next click picks the side. Backspace removes the last click,
/// Escape removes all.
class LoopTool final : public SceneTool {
 public:
  ToolAnswer handle(const InputEvent& event, const ToolScene& scene) override;
  const char* hint(const AppState& state, const Part& part) const override;
  ToolMarks marks() const override;
  bool follows_cursor() const override { return !corners_.empty(); }

  const std::vector<Index>& corners() const { return corners_; }
  void reset() { *this = {}; }

 private:
  ToolAnswer click(const InputEvent& event, const ToolScene& scene);
  ToolAnswer add(Index corner, const ToolScene& scene);
  ToolAnswer close(const ToolScene& scene);
  ToolAnswer choose_side(Index inside, const ToolScene& scene);
  void take_back();
  void hover(const Eigen::Vector2d& pixel, const ToolScene& scene);
  std::vector<Index> line() const;
  bool is_first(const Eigen::Vector2d& pixel, const ToolScene& scene) const;

  std::vector<Index> corners_;
  std::vector<std::vector<Index>> pieces_;  // paths from each corner to the next
  bool closed_ = false;
  Index hovered_ = kNoIndex;
  std::vector<Index> to_cursor_;
};

}  // namespace lapwing::viewer
