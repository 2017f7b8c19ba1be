#pragma once

#include <string_view>

#include "navigation/keymap.h"

namespace lapwing::viewer {

/// A tooltip of the item before, in lines that wrap: what it is or does, and more below, quietly.
void explain(std::string_view what, std::string_view more = {});
/// What the action does, and its key.
void explain(Action action);

}  // namespace lapwing::viewer
