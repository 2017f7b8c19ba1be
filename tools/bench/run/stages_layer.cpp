#include <functional>
#include <string>
#include <vector>

#include "lapwing/run/run_step.h"
#include "run/bench_run.h"

namespace lapwing::bench {
namespace {

// In units of the sheet, whose edges have length 1: above the relief, below the hills.
constexpr double kDetailSize = 10.0;

// Returns the square of a sheet from `left` to `right`, in shares of its width.
RegionSpec square(const Subject& subject, double left, double right) {
  const double size = subject.mesh.positions.back().x();
  constexpr double kLow = 0.33;
  constexpr double kHigh = 0.67;
  RegionSpec region;
  region.form = Box{{left * size, kLow * size, -size}, {right * size, kHigh * size, size}};
  return region;
}

// Two patches of a ninth of the sheet, side by side.
RegionSpec source_patch(const Subject& subject) {
  return square(subject, 0.1, 0.44);
}
RegionSpec target_patch(const Subject& subject) {
  return square(subject, 0.56, 0.9);
}

FileSource coat_source(const Subject& subject) {
  FileSource source;
  source.patch = source_patch(subject);
  source.detail_size = kDetailSize;
  return source;
}

CoatStep coat_step(const Subject& subject) {
  CoatStep step;
  step.source = coat_source(subject);
  step.target_patch = target_patch(subject);
  step.parameters.remesh = Remeshing::none;
  return step;
}

// The second source is the target's own coating, in the farther half of the patch.
MixStep mix_step(const Subject& subject) {
  MixStep step;
  step.target_patch = target_patch(subject);
  step.sources = {coat_source(subject), coat_source(subject)};
  step.sources[1].patch = target_patch(subject);
  step.weight.form = DistanceRamp{square(subject, 0.75, 0.9), kDetailSize};
  step.parameters.remesh = Remeshing::none;
  return step;
}

TransplantStep transplant_step(const Subject& subject) {
  TransplantStep step;
  step.part_region = source_patch(subject);
  step.target_region = target_patch(subject);
  step.parameters.transition = Transition{kDetailSize};
  return step;
}

void measure_step(BenchRun& run, const std::string& stage, const Step& step) {
  const Subject& subject = run.subject();
  for (const BenchDevice& device : run.devices()) {
    RunResult result;
    run.measure(
        stage, device,
        [&] {
          run_step(step, {1, "", *device.kernels, {}, result, {}});
        },
        [&] {
          result = {};
          result.mesh = subject.mesh;
          result.original = result.mesh.positions;
        });
  }
}

}  // namespace

void measure_layer_stages(BenchRun& run) {
  const Subject& subject = run.subject();
  if (!subject.has_relief) return;
  measure_step(run, "coat", coat_step(subject));
  measure_step(run, "mix", mix_step(subject));
  measure_step(run, "transplant", transplant_step(subject));
}

}  // namespace lapwing::bench
