#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "edit_output.h"

namespace lapwing::cli {

struct StepFlags;

/// A step as flags give it: the keys that were given, and those that a flag has a default of its
/// own for. Recipes know the other defaults.
struct StepDraft {
  nlohmann::ordered_json json;
  /// What flags gave, and where it goes: written only when the flags are known to fit each other.
  std::vector<std::pair<nlohmann::ordered_json::json_pointer, nlohmann::ordered_json>> given;
  /// What is known only when all flags are: paths from the recipe, what takes several flags.
  std::vector<std::function<void(nlohmann::ordered_json&, const StepFlags&)>> at_end;
};

/// A command that carries out one step given by flags, as the recipe of that one step: one path
/// from text to edit, and one set of error messages.
struct StepFlags {
  std::string command;  ///< "deform"
  const std::string& mesh;
  const std::string& recipe;  ///< where to write the edit as a recipe; empty: nowhere
  const EditOutput& output;

  /// `path`, as it is from here, as it is from the recipe's folder.
  std::string from_recipe(const std::string& path) const;
  /// Runs the step, writes what `output` and `recipe` ask for. Throws CLI::RequiredError when
  /// nothing would be written.
  void run(const StepDraft& step) const;
};

}  // namespace lapwing::cli
