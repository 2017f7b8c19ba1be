#pragma once

#include <span>

#include "navigation/keymap.h"
#include "tools/disk_tool.h"
#include "tools/gizmo_tool.h"
#include "tools/loop_tool.h"
#include "tools/paint_tool.h"
#include "tools/pin_tool.h"
#include "tools/ruler_tool.h"

namespace lapwing::viewer {

/// The window's own tools.
struct Tools {
  DiskTool disk;
  LoopTool loop;
  PaintTool paint;
  PinTool pin;
  GizmoTool gizmo;
  RulerTool ruler;
};

/// One that can be taken in hand.
struct ToolRow {
  const char* name;
  Action action;  ///< that takes it
  SceneTool& (*take)(Tools& tools);
};

/// All of them, as the panel has them. A new tool is a row here, a member of Tools, and its action
/// in the keymap.
std::span<const ToolRow> tool_rows();
/// Whether it chooses vertices: what a new mesh may begin with.
inline bool chooses(const ToolRow& row) {
  return row.action != Action::take_move && row.action != Action::take_ruler;
}

}  // namespace lapwing::viewer
