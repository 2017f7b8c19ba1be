#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "edit_output.h"

namespace lapwing::cli {

struct StepFlags;

/// A step built from flags: the given keys, and those whose flag has its own default. Other
/// defaults come from the recipe.
struct StepDraft {
  nlohmann::ordered_json json;
  /// Values of flags with their places. They are written only after all flags are known to fit each
  /// other.
  std::vector<std::pair<nlohmann::ordered_json::json_pointer, nlohmann::ordered_json>> given;
  /// Actions that need all flags, such as paths relative to the recipe.
  std::vector<std::function<void(nlohmann::ordered_json&, const StepFlags&)>> at_end;
};

/// A command that runs one step given by flags. It builds a recipe with that step, so that flags
/// and recipes share one code path and one set of messages.
struct StepFlags {
  std::string command;  ///< "deform"
  const std::string& mesh;
  const std::string& recipe;  ///< file for the recipe of the edit; empty: none
  const EditOutput& output;

  /// Converts `path` from relative to the current folder to relative to the recipe's folder.
  std::string from_recipe(const std::string& path) const;
  /// Runs the step and writes the files of `output` and `recipe`. Throws CLI::RequiredError if
  /// nothing would be written.
  void run(const StepDraft& step) const;
};

}  // namespace lapwing::cli
