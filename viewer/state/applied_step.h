#pragma once

#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/step/run_report.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// The result of a step that was carried out, with its report and warnings.
struct CarriedOut {
  std::shared_ptr<const AppliedStep> result;
  StepReport report;
  std::vector<std::string> warnings;
};

/// Carries out `step` on the surface of `state`, settled if it has a result, with the same bits as
/// `run_recipe`. Does not change `state`; `Apply` makes the result a step. Looks for sources in
/// `base_directory`. Throws what `run_recipe` throws, and InputError while a drag waits for its
/// result.
CarriedOut apply_step(const AppState& state, const Step& step,
                      const std::filesystem::path& base_directory, Kernels& kernels,
                      const Progress& progress = {});

}  // namespace lapwing::viewer
