#include "lapwing/session/run_mix.h"

#include "lapwing/base/stage.h"
#include "lapwing/session/run_coat.h"

namespace lapwing {

StepReport run_step(const MixStep& step, const std::filesystem::path& base_directory,
                    Kernels& kernels, const Progress& progress, RunResult& result) {
  StageTimings timings;
  std::vector<SharedSource> sources;
  stage("source", timings, progress,
        [&] { sources = read_source_meshes(step.sources, base_directory); });
  const LayeredCoat mix(layered(step), result.mesh, sources, kernels, progress);
  return take_over(mix, "mix", std::move(timings), mix.positions(1.0), result);
}

}  // namespace lapwing
