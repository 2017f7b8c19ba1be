#include "lapwing/session/run_mix.h"

#include "lapwing/session/layered_coat.h"

namespace lapwing {

StepReport run_step(const MixStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  const LayeredStep layered{.sources = step.sources,
                            .target_patch = step.target_patch,
                            .parameters = step.parameters,
                            .where = step.where,
                            .taken = step.taken,
                            .weight = &step.weight,
                            .handles = step.handles};
  const LayeredCoat mix(layered, result.mesh, result.topology, base_directory, kernels, progress);
  return take_over(mix, "mix", mix.positions(1.0), result);
}

}  // namespace lapwing
