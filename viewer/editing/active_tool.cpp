#include "editing/active_tool.h"

#include <algorithm>

#include "tools/selection_edits.h"

namespace lapwing::viewer {

using Role = Part::Role;

void ActiveTool::take(const ToolRow& row) {
  if (is_dragging()) return;
  tool_ = &row.take(tools_);
  row_ = &row;
  tools_.loop.reset();
}

bool ActiveTool::take(Action action) {
  const auto row = std::ranges::find(tool_rows(), action, &ToolRow::action);
  if (row == tool_rows().end()) return false;
  take(*row);
  return true;
}

void ActiveTool::lend(SceneTool& tool) {
  if (is_dragging()) return;
  tools_.loop.reset();
  tool_ = &tool;
  row_ = nullptr;
}

void ActiveTool::give_back(const SceneTool& tool) {
  if (!is(tool)) return;
  row_ = &tool_rows().front();
  tool_ = &row_->take(tools_);
}

void ActiveTool::choose(const Part& part) {
  if (is_dragging()) return;
  part_ = part;
  tools_.loop.reset();
  if (part.role == Role::handle && part.handle < handle_count()) handle_ = part.handle;
}

void ActiveTool::begin_choosing(const Part& part) {
  choose(part);
  if (!chooses_parts()) take(Action::take_disk);
}

void ActiveTool::go_on() {
  if (part_.role == Role::roi && !session_.state().selection.roi.vertices.empty()) {
    choose({Role::handle, 0});
    if (handle_count() > 0) take(Action::take_move);
  } else if (part_.role == Role::handle && part_.handle < handle_count()) {
    handle_ = part_.handle;
    take(Action::take_move);
  }
}

std::size_t ActiveTool::count(const Part& part) const {
  const VertexSet& chosen = vertices_of(session_.state().selection, part);
  return part == part_ ? tool_->count_with(chosen) : chosen.size();
}

std::vector<Index> ActiveTool::selected() const {
  const EditSelection& selection = session_.state().selection;
  const VertexSet& vertices = vertices_of(selection, part_);
  return vertices.empty() ? selection.roi.vertices : vertices;
}

void ActiveTool::limit_to_handles() {
  if (part_.role == Role::handle) part_.handle = std::min(part_.handle, handle_count());
  handle_ = handle_count() == 0 ? 0 : std::min(handle_, handle_count() - 1);
}

}  // namespace lapwing::viewer
