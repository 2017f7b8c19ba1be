#include "lapwing/recipe/key_visitor.h"
#include "lapwing/recipe/step.h"

namespace lapwing {
namespace {

using Profile = Transition::Profile;

constexpr StepKey kTargetPatch{.name = "target_patch",
                               .help = "the patch that gets the detail; must be a disk",
                               .required = true,
                               .flag_default = "all"};

void describe_detail_size(CoatSource& source, KeyVisitor& visitor) {
  visitor.number({.name = "detail_size",
                  .help = "a length on the source: features smaller than this are its coating. "
                          "Waves half as long are transferred to 94%, waves of this length to 50%, "
                          "waves twice as long to 6%",
                  .required = true},
                 source.detail_size, kAboveZero);
}

void describe_surface(CoatParameters& parameters, KeyVisitor& visitor) {
  visitor.number({.name = "smooth_target",
                  .help = "a length on the target: its own features smaller than this are removed "
                          "first; 0 keeps them under the coating"},
                 parameters.smooth_target, kLength);
  describe(parameters.weights, visitor);
  visitor.choice({.name = "domain", .help = "the shape that both patches are mapped to"},
                 parameters.domain, {{Domain::disk, "disk"}, {Domain::square, "square"}});
}

void describe_laying(CoatSource& source, KeyVisitor& visitor) {
  visitor.pairs({.name = "boundary_pairs",
                 .help = "a vertex on the source's boundary and the vertex on the target's "
                         "boundary that it maps to; the square needs four, in order around the "
                         "boundary. The default pairs align the patches' principal directions, or "
                         "fit the inner pairs; the report lists them",
                 .absent = "chosen",
                 .flag = "boundary-pair"},
                source.boundary_pairs);
  visitor.pairs({.name = "inner_pairs",
                 .help = "an inner vertex of the source and the inner vertex of the target that it "
                         "maps to",
                 .absent = "none",
                 .flag = "inner-pair"},
                source.inner_pairs);
  describe(source.sampling, visitor);
  visitor.number({.name = "amplitude",
                  .help = "factor of the coating; 0 adds no coating, a negative value engraves it"},
                 source.amplitude, kAnyNumber);
}

void describe_fading(CoatParameters& parameters, KeyVisitor& visitor) {
  visitor.object({.name = "transition",
                  .help = "the coating fades in over this width from the patch's boundary; 0 is a "
                          "step. If it exceeds half the patch's width, little coating is left",
                  .absent = "the detail size on the target"},
                 parameters.transition, ObjectForm::optional);
  visitor.choice({.name = "remesh",
                  .help = "refine the patch if it is too coarse for its coating; nothing outside "
                          "changes",
                  .off_flag = "no-remesh",
                  .off_help = "keep the target's triangles, however coarse they are"},
                 parameters.remesh, {{Remeshing::automatic, "auto"}, {Remeshing::none, "none"}});
}

void require_pairs(const CoatSource& source, Domain domain, const std::string& pointer,
                   KeyVisitor& visitor) {
  const std::size_t count = source.boundary_pairs.size();
  const std::string got = std::to_string(count);
  visitor.require(
      count == 0 || count == pin_count(domain), pointer,
      domain == Domain::disk
          ? "the disk needs one pair of boundary vertices, got " + got
          : "the square needs four pairs of boundary vertices in order around it, got " + got);
}

}  // namespace

void describe(CoatOptions& options, KeyVisitor& visitor) {
  visitor.choice({.name = "sampling",
                  .help = "how the coating's Laplacians are sampled: from each target ring mapped "
                          "to the source, or interpolated between the source's vertices, so that a "
                          "finer target does not show the source's triangles"},
                 options.sampling,
                 {{MappedSampling::one_ring, "one_ring"}, {MappedSampling::linear, "linear"}});
  visitor.number({.name = "scale",
                  .help = "ratio of the coating's size on the target to its size on the source; "
                          "`auto` uses the local ratio of lengths, at most four times that of the "
                          "patches",
                  .automatic = true},
                 options.scale,
                 {.least = 0.0, .takes_least = false, .slider_from = 0.1, .slider_to = 10.0});
}

void describe(CoatParameters& parameters, KeyVisitor& visitor) {
  describe_surface(parameters, visitor);
  describe_fading(parameters, visitor);
}

void describe(Transition& transition, KeyVisitor& visitor) {
  visitor.number(
      {.name = "width",
       .help = "width over which one detail blends into the other; chosen automatically if there "
               "is no `transition`",
       .required = true,
       .flag = "transition"},
      transition.width, kLength);
  visitor.choice({.name = "profile", .help = "profile of the transition"}, transition.profile,
                 {{Profile::smooth, "smooth"}, {Profile::linear, "linear"}});
}

void describe(CoatStep& step, KeyVisitor& visitor) {
  visitor.where(step.where);
  visitor.where(step.source.where);
  visitor.file(
      {.name = "source",
       .help = "the file with the detail; by default the mesh as the previous steps left it",
       .absent = "the mesh itself"},
      step.source.mesh);
  visitor.region({.name = "source_patch",
                  .help = "the patch whose detail is copied; must be a disk",
                  .required = true,
                  .flag_default = "all"},
                 step.source.patch);
  visitor.region(kTargetPatch, step.target_patch);
  describe_detail_size(step.source, visitor);
  describe_surface(step.parameters, visitor);
  describe_laying(step.source, visitor);
  describe_fading(step.parameters, visitor);
  require_pairs(step.source, step.parameters.domain, "boundary_pairs", visitor);
}

void describe(FileSource& source, KeyVisitor& visitor) {
  visitor.where(source.where);
  visitor.file({.name = "mesh", .help = "the file with the detail", .absent = "the mesh itself"},
               source.mesh);
  visitor.region({.name = "patch",
                  .help = "the patch whose detail is copied; must be a disk",
                  .required = true,
                  .flag_default = "all"},
                 source.patch);
  describe_detail_size(source, visitor);
  describe_laying(source, visitor);
}

void describe(MixStep& step, KeyVisitor& visitor) {
  static constexpr std::array<std::string_view, 2> kPrefixes{"first", "second"};
  visitor.where(step.where);
  visitor.region(kTargetPatch, step.target_patch);
  visitor.list({.name = "sources", .help = "two sources, each with these keys", .required = true},
               step.sources, {"two sources", "{\"op\": \"coat\"} takes one", kPrefixes});
  visitor.choice({.name = "take",
                  .help = "what is mixed: the detail smaller than each detail size, added to the "
                          "target; or the whole shape of both surfaces, which replaces the target "
                          "inside its fixed boundary"},
                 step.transfer,
                 {{TransferMode::coating, "coating"}, {TransferMode::shape, "shape"}});
  visitor.weight({.name = "weight",
                  .help = "the second source's share: by distance from a region, by the coordinate "
                          "v of the square domain, or painted",
                  .required = true},
                 step.weight);
  visitor.choice({.name = "profile", .help = "profile of the weight", .flag = "weight-profile"},
                 step.weight.profile, {{Profile::smooth, "smooth"}, {Profile::linear, "linear"}});
  visitor.only_when(!std::holds_alternative<PaintedWeight>(step.weight.form), "profile",
                    "a painted field has no profile; remove \"profile\"");
  visitor.handles({.name = "handles",
                   .help = "handles as in deform, inside the patch; they move in the same solve",
                   .absent = "none"},
                  step.handles, HandleForm::firm);
  describe_surface(step.parameters, visitor);
  describe_fading(step.parameters, visitor);
  const Domain domain = step.parameters.domain;
  visitor.require(domain == Domain::square || !std::holds_alternative<DomainRamp>(step.weight.form),
                  "weight/domain_v",
                  "only the square domain has a coordinate v; add \"domain\": \"square\", or use "
                  "\"distance_to\"");
  for (std::size_t k = 0; k < step.sources.size(); ++k) {
    require_pairs(step.sources[k], domain, "sources/" + std::to_string(k) + "/boundary_pairs",
                  visitor);
  }
}

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

}  // namespace lapwing
