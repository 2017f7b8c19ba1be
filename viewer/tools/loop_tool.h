#pragma once

#include <vector>

#include "tools/input.h"
#include "tools/select_scene.h"
#include "tools/tool_answer.h"

namespace lapwing::viewer {

/// Chooses one side of a closed loop: clicks are joined along the mesh; a click on the first one or
/// Enter closes the loop; the next click says which side. Backspace takes the last click back,
/// Escape all of them.
class LoopTool {
 public:
  ToolAnswer handle(const InputEvent& event, const SelectScene& scene);

  const std::vector<Index>& corners() const { return corners_; }
  /// The vertices of the line so far, the piece to the cursor included; the first again at the end
  /// once it is closed.
  std::vector<Index> line() const;
  bool is_closed() const { return closed_; }

  void reset() { *this = {}; }

 private:
  ToolAnswer click(const InputEvent& event, const SelectScene& scene);
  ToolAnswer add(Index corner, const SelectScene& scene);
  ToolAnswer close(const SelectScene& scene);
  ToolAnswer choose_side(Index inside, const SelectScene& scene);
  void take_back();
  void hover(const Eigen::Vector2d& pixel, const SelectScene& scene);
  bool is_first(const Eigen::Vector2d& pixel, const SelectScene& scene) const;

  std::vector<Index> corners_;
  std::vector<std::vector<Index>> pieces_;  // from each corner to the next
  bool closed_ = false;
  Index hovered_ = kNoIndex;
  std::vector<Index> to_cursor_;
};

}  // namespace lapwing::viewer
