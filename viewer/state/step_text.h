#pragma once

#include <filesystem>
#include <string>

#include "lapwing/step/step.h"

namespace lapwing::viewer {

/// Returns the step's name in the history: "coat from gargoyle.off".
std::string describe(const Step& step);

/// Returns the step with absolute file paths, resolved in `base_directory`. States keep steps in
/// this form, because a state has no folder.
Step with_absolute_paths(Step step, const std::filesystem::path& base_directory);

/// Returns the step as a recipe in the folder `base_directory` writes it.
Step with_paths_from(Step step, const std::filesystem::path& base_directory);

}  // namespace lapwing::viewer
