#pragma once

#include <optional>
#include <string>

#include "state/command.h"

namespace lapwing::viewer {

/// What a tool made of one event.
struct ToolAnswer {
  bool taken = false;              ///< nobody else should act on it
  std::optional<Command> command;  ///< to perform
  std::string message;             ///< for the person, when something did not work

  static ToolAnswer passed_on() { return {}; }
  static ToolAnswer only_taken() { return {true, {}, {}}; }
};

}  // namespace lapwing::viewer
