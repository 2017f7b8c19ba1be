#pragma once

#include <optional>
#include <string>

#include "state/command.h"

namespace lapwing::viewer {

/// What a tool made of one event.
struct ToolAnswer {
  bool taken = false;                     ///< nobody else should act on it
  std::optional<Command> command = {};    ///< to perform
  std::string message = {};               ///< for the person, when something did not work
  std::optional<std::size_t> holds = {};  ///< a handle to be taken hold of, after the command
  bool drags_held = false;                ///< in the plane of the view, until the button is let go
  bool resizes = false;                   ///< the command only sizes what the tool chose last

  static ToolAnswer passed_on() { return {}; }
  static ToolAnswer only_taken() { return {.taken = true}; }
};

}  // namespace lapwing::viewer
