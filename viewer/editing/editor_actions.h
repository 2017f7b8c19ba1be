#pragma once

#include "editing/detail_transfer_tool.h"
#include "navigation/keymap.h"

namespace lapwing::viewer {

/// Carries out a key's action on the edit. Returns false for actions of the camera, files and
/// panels.
bool perform_on(Editor& editor, Action action);
/// The same for a coat or mix in progress.
bool perform_on(DetailTransferTool& desk, Editor& editor, Action action);

}  // namespace lapwing::viewer
