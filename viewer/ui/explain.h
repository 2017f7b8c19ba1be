#pragma once

#include <string_view>

#include "navigation/keymap.h"

namespace lapwing::viewer {

/// Adds a tooltip to the last item: `what` it is or does, and `more` below in grey. Lines wrap.
void explain(std::string_view what, std::string_view more = {});
/// Likewise, with the description and the key of an action.
void explain(Action action);

}  // namespace lapwing::viewer
