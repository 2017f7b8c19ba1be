#pragma once

#include <optional>

#include "tools/paint_tool.h"

namespace lapwing::viewer {

/// A brush for values on the whole surface. It does not change the selection.
class SurfaceBrush {
 public:
  struct Stroke {
    VertexSet vertices;  ///< with the followers of joined vertices
    bool erases = false;
  };
  struct Answer {
    ToolAnswer answer;             ///< without a command
    std::optional<Stroke> stroke;  ///< set if the event has finished a stroke
  };

  SurfaceBrush() { tool_.options().shape = PaintTool::Shape::brush; }

  Answer handle(const InputEvent& event, const ToolScene& scene);
  /// The stroke under way and its marks.
  const PaintTool& tool() const { return tool_; }
  PaintTool::Options& options() { return tool_.options(); }

 private:
  PaintTool tool_;
};

}  // namespace lapwing::viewer
