#include "lapwing/session/run_coat.h"

#include "lapwing/session/prepared_coat.h"

namespace lapwing {

StepReport run_step(const CoatStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  const PreparedCoat coat(step, result.mesh, result.topology, base_directory, kernels, progress);
  return take_over(coat.layers(), "coat", coat.positions(step.source.amplitude), result);
}

}  // namespace lapwing
