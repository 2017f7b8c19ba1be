#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "coat_flags.h"
#include "commands.h"
#include "edit_output.h"
#include "handle_flags.h"
#include "lapwing/base/errors.h"
#include "lapwing/io/mesh_file.h"
#include "region_text.h"
#include "step_flags.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MixArguments {
  std::string mesh;
  SourceFlags first;
  SourceFlags second;
  CoatedFlags coated;
  std::string take = "coating";
  std::vector<double> domain_v;
  std::string distance_to;
  double width = 0.0;
  std::string field;
  std::optional<std::string> weight_profile;
  HandleFlags handle;
  std::string recipe;
  EditOutput output;
};

Json source_json(const SourceFlags& source, const std::string& name, const StepFlags& flags) {
  Json json = Json::object();
  if (!source.mesh.empty()) json["mesh"] = flags.from_recipe(source.mesh);
  json["patch"] = region_json("--" + name + "-patch", source.patch);
  source.write(json);
  return json;
}

// The numbers of a vertex property of the mesh, which `lapwing peel` and other programs write.
std::vector<double> property(const std::string& mesh, const std::string& name) {
  for (const ExtraAttribute& extra : read_mesh(mesh).attributes.vertex_extras) {
    if (extra.name == name && extra.components == 1) return extra.values;
  }
  throw InputError("--field: " + mesh + " has no vertex property \"" + name +
                   "\" of one number; PLY files hold such");
}

Json weight_json(const MixArguments& a) {
  if (!a.domain_v.empty()) return {{"domain_v", a.domain_v}};
  if (!a.field.empty()) return {{"field", property(a.mesh, a.field)}};
  return {{"distance_to", region_json("--distance-to", a.distance_to)}, {"width", a.width}};
}

Json step_json(const MixArguments& a, const StepFlags& flags) {
  Json step = {{"op", "mix"}};
  step["sources"] =
      Json::array({source_json(a.first, "first", flags), source_json(a.second, "second", flags)});
  step["take"] = a.take;
  step["weight"] = weight_json(a);
  if (a.weight_profile) step["profile"] = *a.weight_profile;
  if (!a.handle.handle.empty()) step["handles"] = Json::array({a.handle.json()});
  a.coated.write(step);
  return step;
}

void mix(const MixArguments& a) {
  if (a.domain_v.empty() && a.distance_to.empty() && a.field.empty()) {
    throw CLI::RequiredError("one of --domain-v, --distance-to and --field");
  }
  const StepFlags flags{"mix", a.mesh, a.recipe, a.output};
  flags.run(step_json(a, flags));
}

void add_weight_options(CLI::App& command, MixArguments& a) {
  auto* ramp = command
                   .add_option("--domain-v", a.domain_v,
                               "A,B: the second source's share goes from 0 to 1 between these v of "
                               "the square domain")
                   ->delimiter(',')
                   ->expected(2);
  auto* distance = command.add_option(
      "--distance-to", a.distance_to,
      std::string("all of the second source here, none --width away: ") + kRegionHelp);
  command.add_option("--width", a.width, "length, for --distance-to; 0: a step")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->needs(distance);
  auto* field = command.add_option(
      "--field", a.field, "vertex property of MESH that is the second source's share, 0 to 1");
  ramp->excludes(distance)->excludes(field);
  distance->excludes(field);
  command
      .add_option("--weight-profile", a.weight_profile,
                  "smooth (if not given) or linear: how the share goes from 0 to 1")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->excludes(field);
}

}  // namespace

void add_mix(CLI::App& app) {
  auto* command = app.add_subcommand("mix", "mix the detail of two surfaces on a third, by flags");
  auto a = std::make_shared<MixArguments>();
  command->add_option("MESH", a->mesh, "the target: OBJ, OFF, PLY or STL")->required();
  a->first.add_to(*command, "first", "first-");
  a->second.add_to(*command, "second", "second-");
  command->add_option("--take", a->take, "what is mixed: detail over the target, or whole shapes")
      ->check(CLI::IsMember({"coating", "shape"}))
      ->capture_default_str();
  add_weight_options(*command, *a);
  a->coated.add_to(*command);
  a->handle.add_to(*command);
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a] { mix(*a); });
}

}  // namespace lapwing::cli
