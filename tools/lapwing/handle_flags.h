#pragma once

#include <string>

#include "move_flags.h"

namespace lapwing::cli {

/// A handle and how it moves, by flags.
struct HandleFlags {
  std::string handle;
  MoveFlags move;

  /// Returns the option "--handle".
  CLI::Option* add_to(CLI::App& command);
  /// The handle with its region and move, as in a recipe.
  nlohmann::ordered_json json() const;
};

}  // namespace lapwing::cli
