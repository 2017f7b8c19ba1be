#include "lapwing/step/transplant_step.h"

#include "lapwing/base/stage.h"
#include "lapwing/step/coat_step.h"
#include "lapwing/step/deform_step.h"
#include "lapwing/step/key_visitor.h"
#include "lapwing/step/step_run.h"
#include "lapwing/transplant/transplant.h"

namespace lapwing {

void describe(TransplantParameters& parameters, KeyVisitor& visitor) {
  visitor.object({.name = "transition",
                  .help = "the detail goes over from the host's to the part's within this geodesic "
                          "distance of the part's loop; narrow is sharp, wide is soft",
                  .absent = "half the hole's radius or what fits, smooth"},
                 parameters.transition, ObjectForm::optional);
  visitor.group({.name = "belt",
                 .help = "beyond it, on both sides, vertices are free over `padding` and held over "
                         "`width`; farther away nothing moves, to the last bit",
                 .absent = "half and a quarter of that"},
                parameters.padding || parameters.belt, [&](KeyVisitor& inside) {
                  inside.number({.name = "padding",
                                 .help = "free on both sides beyond it",
                                 .absent = "half the transition"},
                                parameters.padding, kFromZero);
                  inside.number({.name = "width",
                                 .help = "held beyond that",
                                 .absent = "a quarter of it",
                                 .flag = "belt"},
                                parameters.belt, kAboveZero);
                });
  describe(parameters.weights, visitor);
  visitor.choice({.name = "sampling", .help = "of the Laplacians of what was cut out"},
                 parameters.sampling,
                 {{MappedSampling::one_ring, "one_ring"}, {MappedSampling::linear, "linear"}});
  visitor.choice({.name = "remesh",
                  .help = "makes triangles between the loops and over the transition even where "
                          "the meshes' scales differ or the strip is wide; none keeps the part's "
                          "triangles and the strip",
                  .off_flag = "no-remesh",
                  .off_help = "keep the triangles around the seam, however uneven they are"},
                 parameters.remesh, {{Remeshing::automatic, "auto"}, {Remeshing::none, "none"}});
}

void describe(TransplantStep& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.part(
      {.name = "part",
       .help = "a mesh with a boundary loop; or what is cut from a mesh, without `mesh` from "
               "the mesh itself",
       .required = true},
      step.part, step.part_region);
  visitor.whole({.name = "loop",
                 .help = "which boundary loop is sewn on, numbered by their smallest vertices",
                 .absent = "the longest"},
                step.loop);
  visitor.place({.name = "place",
                 .help = "fits the part's loop to the hole, turned by `rotate_degrees` about the "
                         "hole's normal, larger by `scale`, or not scaled at all with `keep_size`; "
                         "or a move as in deform, from where the part is in its file, its pivot "
                         "the centre of its loop"},
                step.place,
                {.name = "snap",
                 .help = "after a move, the least motion that brings the loop onto the surface"},
                step.snap);
  visitor.region({.name = "target_region",
                  .help = "what is cut out; its boundary must be one loop",
                  .required = true},
                 step.target_region);
  describe(step.parameters, visitor);
}

std::shared_ptr<const Mesh> read_part_mesh(const TransplantStep& step,
                                           const std::filesystem::path& base_directory,
                                           const MeshShelf& meshes) {
  return step.part.empty() ? nullptr : meshes.mesh(base_directory, step.part);
}

StepReport run_step(const TransplantStep& step, const StepRun& on) {
  RunResult& result = on.result;
  StepReport report;
  std::shared_ptr<const Mesh> read;
  stage("part", report.timings, on.progress,
        [&] { read = read_part_mesh(step, on.base_directory, on.meshes); });
  if (read) result.inputs.push_back(split_mesh_path(on.base_directory / step.part).file);
  const Mesh& part = read ? *read : result.mesh;
  const std::string name = read ? step.part.stem().string() : "part";
  Transplanted done = transplant(result.mesh, part, name, step, on.kernels, on.progress);
  for (const auto& [stage_name, ms] : done.timings.stages()) report.timings.add(stage_name, ms);
  result.warn(done.warnings);
  report.roi = done.region.size();
  report.belt = done.belt.size();
  report.free = report.roi - report.belt;
  report.transplant = std::move(done.report);
  Positions original = std::move(done.placed);
  for (std::size_t v = 0; v < original.size(); ++v) {
    const Index host = done.host_vertices[v];
    if (host != kNoIndex) original[v] = result.original[host];
  }
  result.original = std::move(original);
  result.mesh = std::move(done.mesh);
  result.region = {std::move(done.region), std::move(done.belt), {}};
  return report;
}

}  // namespace lapwing
