#include "tools/guide.h"

namespace lapwing::viewer {

Guide guide_of(const AppState& state, const Part& part, const SceneTool& tool, bool moves) {
  const bool has_roi = !state.selection.roi.vertices.empty();
  const bool has_handle = !state.selection.handles.empty();
  Guide guide;
  guide.steps = {{{"Region", has_roi}, {"Handle", has_handle}, {"Drag", is_moved(state)}, {}}};
  const bool can_move = moves && has_roi && has_handle;
  guide.current = can_move ? 2 : part.role == Part::Role::handle && has_roi ? 1 : 0;
  guide.what = tool.hint(state, part);
  if (can_move && is_moved(state)) guide.what = "drag the gizmo on; Ctrl+N begins another edit";
  return guide;
}

}  // namespace lapwing::viewer
