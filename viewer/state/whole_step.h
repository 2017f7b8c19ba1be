#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lapwing/base/cancellation.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/recipe/step.h"
#include "lapwing/run/run_report.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// Returns the step's name for the history: "coat from gargoyle.off".
std::string describe(const Step& step);

/// Returns the step with absolute file paths. Relative paths are resolved in `base_directory`. The
/// steps of an AppState have this form.
Step with_absolute_paths(Step step, const std::filesystem::path& base_directory);

/// Returns the step with file paths relative to `base_directory`, the folder of a recipe.
Step with_paths_from(Step step, const std::filesystem::path& base_directory);

/// The result of a step that was carried out, with its report and warnings.
struct CarriedOut {
  std::shared_ptr<const AppliedStep> result;
  StepReport report;
  std::vector<std::string> warnings;
};

/// Carries out `step` on the settled surface of `state`, or on its rest shape if no handle has
/// moved. The result is bitwise identical to that of `run_recipe`. To add it as a step, pass it to
/// `Apply`. The file paths of sources are relative to `base_directory`. Throws the errors of
/// `run_recipe`. Throws InputError if the result of a drag is not yet computed.
CarriedOut apply_step(const AppState& state, const Step& step,
                      const std::filesystem::path& base_directory, Kernels& kernels,
                      const Progress& progress = {});

}  // namespace lapwing::viewer
