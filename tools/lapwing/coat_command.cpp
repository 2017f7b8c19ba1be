#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "region_text.h"
#include "step_flags.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CoatArguments {
  std::string mesh;
  std::string source;
  std::string source_patch = "all";
  std::string target_patch = "all";
  double detail_size = 0.0;
  double smooth_target = 0.0;
  std::string weights = "cotangent";
  std::string domain = "disk";
  std::vector<std::vector<Index>> boundary_pairs;
  std::vector<std::vector<Index>> inner_pairs;
  std::string sampling = "one_ring";
  std::optional<double> scale;
  double amplitude = 1.0;
  std::optional<double> transition_width;
  std::string transition_profile = "smooth";
  bool no_remesh = false;
  std::string recipe;
  EditOutput output;
};

Json step_json(const CoatArguments& a, const StepFlags& flags) {
  Json step = {{"op", "coat"}};
  if (!a.source.empty()) step["source"] = flags.from_recipe(a.source);
  step["source_patch"] = region_json("--source-patch", a.source_patch);
  step["target_patch"] = region_json("--target-patch", a.target_patch);
  step["detail_size"] = a.detail_size;
  step["smooth_target"] = a.smooth_target;
  step["weights"] = a.weights;
  step["domain"] = a.domain;
  step["boundary_pairs"] = a.boundary_pairs;
  step["inner_pairs"] = a.inner_pairs;
  step["sampling"] = a.sampling;
  if (a.scale) step["scale"] = *a.scale;
  step["amplitude"] = a.amplitude;
  if (a.transition_width) {
    step["transition"] = {{"width", *a.transition_width}, {"profile", a.transition_profile}};
  }
  step["remesh"] = a.no_remesh ? "none" : "auto";
  return step;
}

void coat(const CoatArguments& a) {
  const StepFlags flags{"coat", a.mesh, a.recipe, a.output};
  flags.run(step_json(a, flags));
}

void add_map_options(CLI::App& command, CoatArguments& a) {
  command.add_option("--domain", a.domain, "what both patches are laid into")
      ->check(CLI::IsMember({"disk", "square"}))
      ->capture_default_str();
  command
      .add_option("--boundary-pair", a.boundary_pairs,
                  "S,T: vertices of the two borders that belong together; one for the disk, four "
                  "in order for the square; chosen and reported if not given")
      ->delimiter(',')
      ->type_size(2)
      ->expected(-1);
  command
      .add_option("--inner-pair", a.inner_pairs,
                  "S,T: vertices inside that belong together; repeat")
      ->delimiter(',')
      ->type_size(2)
      ->expected(-1);
}

}  // namespace

void add_coat(CLI::App& app) {
  auto* command =
      app.add_subcommand("coat", "put the fine detail of one surface on another, by flags");
  auto a = std::make_shared<CoatArguments>();
  command->add_option("MESH", a->mesh, "the target: OBJ, OFF, PLY or STL")->required();
  command->add_option("--source", a->source, "the mesh with the detail; MESH itself if not given");
  command->add_option("--source-patch", a->source_patch, kRegionHelp)->capture_default_str();
  command->add_option("--target-patch", a->target_patch, kRegionHelp)->capture_default_str();
  command
      ->add_option("--detail-size", a->detail_size,
                   "length on the source: what is smaller is carried over")
      ->required()
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--smooth-target", a->smooth_target,
                   "length: the target's own features below it go first")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->add_option("--weights", a->weights)
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  add_map_options(*command, *a);
  command->add_option("--sampling", a->sampling, "of the source's Laplacians")
      ->check(CLI::IsMember({"one_ring", "linear"}))
      ->capture_default_str();
  command->add_option("--scale", a->scale, "of the detail; the local ratio of lengths if not given")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--amplitude", a->amplitude,
                   "of the detail: 0 leaves the target, negative engraves")
      ->capture_default_str();
  auto* width = command->add_option("--transition", a->transition_width,
                                    "length over which the detail fades in from the border; about "
                                    "the detail size if not given");
  width->check(CLI::NonNegativeNumber);
  command->add_option("--profile", a->transition_profile, "of the transition")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->capture_default_str()
      ->needs(width);
  command->add_flag("--no-remesh", a->no_remesh,
                    "keep the target's triangles, however coarse they are");
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a] { coat(*a); });
}

}  // namespace lapwing::cli
