#pragma once

#include <filesystem>
#include <string>

#include "lapwing/step/step.h"

namespace lapwing::viewer {

/// What the history calls it: "coat from gargoyle.off".
std::string describe(const Step& step);

/// The step with the files that it names as absolute paths, looked for in `base_directory`: so
/// steps are kept in a state, which has no place of its own.
Step with_absolute_paths(Step step, const std::filesystem::path& base_directory);

/// The step as a recipe in the folder `base_directory` writes it.
Step with_paths_from(Step step, const std::filesystem::path& base_directory);

}  // namespace lapwing::viewer
