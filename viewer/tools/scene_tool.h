#pragma once

#include <optional>
#include <vector>

#include "tools/disk_rim.h"
#include "tools/input.h"
#include "tools/tool_answer.h"
#include "tools/tool_scene.h"

namespace lapwing::viewer {

/// The marks that a tool draws over the surface.
struct ToolMarks {
  std::vector<Index> line;  ///< through these vertices
  bool line_is_done = false;
  std::vector<Index> dots;
  std::vector<RimGrip> grips;            ///< can be dragged
  std::optional<std::size_t> grip;       ///< index of the one under the cursor
  std::vector<Eigen::Vector2d> outline;  ///< a closed line, in pixels
  double brush_pt = 0.0;                 ///< radius of a circle around the cursor
};

/// What the left button does on the surface. It is one of the window's tools
/// (editing/tool_table.h), or one that a panel lends to the editor.
class SceneTool {
 public:
  virtual ~SceneTool() = default;

  virtual ToolAnswer handle(const InputEvent& event, const ToolScene& scene) = 0;
  /// Whether a stroke is under way, which nothing else may interrupt.
  virtual bool is_dragging() const { return false; }
  /// Whether the tool works on its own preview, even if its triangles are not those of the state.
  virtual bool draws_preview() const { return false; }
  /// Returns what to do next to choose `part` of `state`.
  virtual const char* hint(const AppState& state, const Part& part) const = 0;

  /// The vertices of the stroke under way, and whether it erases them.
  virtual VertexSet live() const { return {}; }
  virtual bool erases() const { return false; }
  /// Returns how many vertices would be chosen, instead of `chosen`, if the stroke ended now.
  virtual std::size_t count_with(const VertexSet& chosen) const { return chosen.size(); }
  /// Whether the last choice may still change, so that nothing else should follow yet.
  virtual bool may_change_choice() const { return false; }

  virtual ToolMarks marks() const { return {}; }
  /// Whether the marks follow the cursor.
  virtual bool follows_cursor() const { return false; }

 protected:
  /// Returns the hint for the role of `part`.
  static const char* of_part(const Part& part, const char* roi, const char* belt,
                             const char* handle) {
    return part.role == Part::Role::roi ? roi : part.role == Part::Role::belt ? belt : handle;
  }
};

}  // namespace lapwing::viewer
