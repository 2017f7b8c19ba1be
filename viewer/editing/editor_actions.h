#pragma once

#include "editing/layer_desk.h"
#include "navigation/keymap.h"

namespace lapwing::viewer {

/// Carries out what a key says of the edit. False for what is not the editor's: camera, files and
/// panels.
bool perform_on(Editor& editor, Action action);
/// Likewise of a coat or mix in the making.
bool perform_on(LayerDesk& desk, Editor& editor, Action action);

}  // namespace lapwing::viewer
