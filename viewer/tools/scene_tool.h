#pragma once

#include "tools/input.h"
#include "tools/select_scene.h"
#include "tools/tool_answer.h"

namespace lapwing::viewer {

/// A tool that a panel lends to the editor: while it is in hand what is done over the surface goes
/// to it.
class SceneTool {
 public:
  virtual ~SceneTool() = default;

  virtual ToolAnswer handle(const InputEvent& event, const SelectScene& scene) = 0;
  /// Whether a stroke is under way, which nothing else may interrupt.
  virtual bool is_dragging() const { return false; }
  /// Whether what is shown is a preview of its own, on which it works whatever the triangles.
  virtual bool draws_preview() const { return false; }
  /// What to do next.
  virtual const char* hint() const = 0;
};

}  // namespace lapwing::viewer
