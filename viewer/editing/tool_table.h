#pragma once

#include <span>

#include "navigation/keymap.h"
#include "tools/disk_tool.h"
#include "tools/gizmo_tool.h"
#include "tools/grab_tool.h"
#include "tools/loop_tool.h"
#include "tools/paint_tool.h"
#include "tools/pin_tool.h"
#include "tools/ruler_tool.h"
#include "tools/stiffness_paint.h"

namespace lapwing::viewer {

/// The tools of the window.
struct Tools {
  GrabTool grab;
  DiskTool disk;
  LoopTool loop;
  PaintTool paint;
  PinTool pin;
  StiffnessPaint stiffness;
  GizmoTool gizmo;
  RulerTool ruler;
};

/// A tool that can be activated.
struct ToolRow {
  const char* name;
  Action action;  ///< activates it
  SceneTool& (*take)(Tools& tools);
};

/// All tools, in the order of the panel. A new tool needs a row here, a member of Tools, and its
/// action in the keymap.
std::span<const ToolRow> tool_rows();
/// Returns whether the tool chooses vertices, so that a new mesh may begin with it.
inline bool chooses(const ToolRow& row) {
  return row.action != Action::take_move && row.action != Action::take_ruler &&
         row.action != Action::take_stiffness;
}

}  // namespace lapwing::viewer
