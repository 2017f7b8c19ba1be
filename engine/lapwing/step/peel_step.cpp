#include "lapwing/step/peel_step.h"

#include <utility>

#include "lapwing/base/stage.h"
#include "lapwing/step/deform_step.h"
#include "lapwing/step/key_visitor.h"
#include "lapwing/step/step_context.h"

namespace lapwing {

void describe(PeelRequest& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.region({.name = "region",
                  .help = "the region whose detail is removed; its boundary stays fixed",
                  .required = true,
                  .flag_default = "all"},
                 step.region);
  visitor.number({.name = "detail_size",
                  .help = "a length on the mesh: features smaller than this are removed",
                  .required = true},
                 step.detail_size, kAboveZero);
  describe(step.weights, visitor);
}

StepReport run_step(const PeelRequest& step, const StepContext& on) {
  StepReport report;
  Peeled peeled;
  stage("peel", report.timings, on.progress,
        [&] { peeled = peel(on.result.mesh, step, on.progress); });
  const VertexSet region = resolve(step.region, on.result.mesh);
  report.roi = region.size();
  report.free = peeled.moved.size();
  report.belt = report.roi - report.free;
  report.peel = PeelReport{peeled.mean_coating, peeled.largest_coating};
  on.result.region = {region, subtract(region, peeled.moved), {}};
  on.result.warn(peeled.warnings);
  on.result.mesh.positions = std::move(peeled.mesh.positions);
  return report;
}

}  // namespace lapwing
