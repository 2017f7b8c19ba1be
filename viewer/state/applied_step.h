#pragma once

#include <string>
#include <vector>

#include "lapwing/base/progress.h"
#include "lapwing/kernels/kernels.h"
#include "lapwing/step/run_report.h"
#include "state/app_state.h"

namespace lapwing::viewer {

/// What a step that was carried out came to, and what there is to say of it.
struct CarriedOut {
  std::shared_ptr<const AppliedStep> result;
  StepReport report;
  std::vector<std::string> warnings;
};

/// Carries `step` out on the surface of `state`, with what is settled, as `run_recipe` does: the
/// same bits. Nothing of `state` changes; `Apply` makes the result a step. Sources are looked for
/// in `base_directory`. Throws what `run_recipe` does, and InputError while a drag waits for its
/// result.
CarriedOut apply_step(const AppState& state, const Step& step,
                      const std::filesystem::path& base_directory, Kernels& kernels,
                      const Progress& progress = {});

}  // namespace lapwing::viewer
