#pragma once

#include <optional>
#include <string>

#include "state/command.h"

namespace lapwing::viewer {

/// The response of a tool to one event.
struct ToolAnswer {
  bool taken = false;                     ///< no one else should handle the event
  std::optional<Command> command = {};    ///< to perform
  std::string message = {};               ///< for the user, if something failed
  std::optional<std::size_t> holds = {};  ///< handle to select after the command
  bool drags_held = false;                ///< drag it in the view plane until the button goes up
  bool resizes = false;                   ///< the command only resizes the last choice

  static ToolAnswer passed_on() { return {}; }
  static ToolAnswer only_taken() { return {.taken = true}; }
};

}  // namespace lapwing::viewer
