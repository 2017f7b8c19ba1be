#pragma once

#include <vector>

#include "editing/tool_table.h"
#include "work/edit_session.h"

namespace lapwing::viewer {

/// Holds the tools of an edit: which one is active, the part of the selection that it chooses, and
/// the handle that the gizmo moves. `take`, `lend` and `choose` do nothing while a stroke or drag
/// is in progress.
class ActiveTool {
 public:
  explicit ActiveTool(const EditSession& session) : session_(session) {}

  Tools& tools() { return tools_; }
  const Tools& tools() const { return tools_; }

  /// Returns the active tool.
  const SceneTool& scene_tool() const { return *tool_; }
  SceneTool& scene_tool() { return *tool_; }
  bool is(const SceneTool& tool) const { return tool_ == &tool; }
  /// Its row of `tool_rows`; null for a panel's tool.
  const ToolRow* row() const { return row_; }
  /// Returns whether a stroke or drag is in progress, including a drag of the gizmo.
  bool is_dragging() const { return tools_.gizmo.is_dragging() || tool_->is_dragging(); }
  bool has_gizmo() const { return is(tools_.gizmo) && handle_ < handle_count(); }

  void take(const ToolRow& row);
  /// Activates the action's tool. Returns whether it has one.
  bool take(Action action);
  /// Activates a tool that a panel owns. The tool must stay alive until `give_back`.
  void lend(SceneTool& tool);
  void give_back(const SceneTool& tool);

  /// The part that the tools choose.
  const Part& part() const { return part_; }
  void choose(const Part& part);
  /// Returns whether the active tool chooses vertices of `part()`.
  bool chooses_parts() const { return is(tools_.disk) || is(tools_.loop) || is(tools_.paint); }
  /// Calls `choose`, and activates the disk unless the active tool chooses parts.
  void begin_choosing(const Part& part);
  /// Goes on to the usual next task: from choosing the ROI to choosing a handle, and then to moving
  /// it.
  void go_on();
  /// Returns the number of vertices of `part`, including those that are being chosen.
  std::size_t count(const Part& part) const;
  /// Returns the vertices of the active part, or those of the ROI if the active part is empty.
  std::vector<Index> selected() const;

  std::size_t handle() const { return handle_; }  ///< the handle to move
  /// Call this when the state has changed, because it may have fewer handles.
  void limit_to_handles();

 private:
  std::size_t handle_count() const { return session_.state().selection.handles.size(); }

  const EditSession& session_;
  Tools tools_;
  SceneTool* tool_ = &tools_.grab;
  const ToolRow* row_ = &tool_rows().front();
  Part part_;
  std::size_t handle_ = 0;
};

}  // namespace lapwing::viewer
