#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

#include "edit_output.h"

namespace lapwing::cli {

struct StepDraft;

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
