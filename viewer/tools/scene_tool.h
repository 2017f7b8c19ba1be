#pragma once

#include <optional>
#include <vector>

#include "tools/disk_rim.h"
#include "tools/input.h"
#include "tools/tool_answer.h"
#include "tools/tool_scene.h"

namespace lapwing::viewer {

/// What a tool has drawn over the surface.
struct ToolMarks {
  std::vector<Index> line;  ///< through these vertices
  bool line_is_done = false;
  std::vector<Index> dots;
  std::vector<RimGrip> grips;            ///< to be dragged
  std::optional<std::size_t> grip;       ///< of them, the one under the cursor
  std::vector<Eigen::Vector2d> outline;  ///< a closed line, in pixels
  double brush_pt = 0.0;                 ///< radius of a circle around the cursor
};

/// What the left button does on the surface: a tool of the window's own (editing/tool_table.h), or
/// one that a panel lends to the editor.
class SceneTool {
 public:
  virtual ~SceneTool() = default;

  virtual ToolAnswer handle(const InputEvent& event, const ToolScene& scene) = 0;
  /// Whether a stroke is under way, which nothing else may interrupt.
  virtual bool is_dragging() const { return false; }
  /// Whether what is shown is a preview of its own, on which it works whatever the triangles.
  virtual bool draws_preview() const { return false; }
  /// What to do next, to choose `part` of `state`.
  virtual const char* hint(const AppState& state, const Part& part) const = 0;

  /// The vertices of the stroke under way, and whether it takes them away.
  virtual VertexSet live() const { return {}; }
  virtual bool erases() const { return false; }
  /// How many vertices would be chosen, in place of `chosen`, if the stroke under way ended here.
  virtual std::size_t count_with(const VertexSet& chosen) const { return chosen.size(); }
  /// Whether what was chosen last may still be changed, so that nothing else should follow yet.
  virtual bool may_change_choice() const { return false; }

  virtual ToolMarks marks() const { return {}; }
  /// Whether the marks go with the cursor.
  virtual bool follows_cursor() const { return false; }

 protected:
  /// The hint that goes with the part that is chosen.
  static const char* of_part(const Part& part, const char* roi, const char* belt,
                             const char* handle) {
    return part.role == Part::Role::roi ? roi : part.role == Part::Role::belt ? belt : handle;
  }
};

}  // namespace lapwing::viewer
