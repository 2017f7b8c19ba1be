#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "coat_flags.h"
#include "commands.h"
#include "edit_output.h"
#include "region_text.h"
#include "step_flags.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CoatArguments {
  std::string mesh;
  SourceFlags source;
  CoatedFlags coated;
  std::string recipe;
  EditOutput output;
};

Json step_json(const CoatArguments& a, const StepFlags& flags) {
  Json step = {{"op", "coat"}};
  if (!a.source.mesh.empty()) step["source"] = flags.from_recipe(a.source.mesh);
  step["source_patch"] = region_json("--source-patch", a.source.patch);
  a.source.write(step);
  a.coated.write(step);
  return step;
}

void coat(const CoatArguments& a) {
  const StepFlags flags{"coat", a.mesh, a.recipe, a.output};
  flags.run(step_json(a, flags));
}

}  // namespace

void add_coat(CLI::App& app) {
  auto* command =
      app.add_subcommand("coat", "put the fine detail of one surface on another, by flags");
  auto a = std::make_shared<CoatArguments>();
  command->add_option("MESH", a->mesh, "the target: OBJ, OFF, PLY or STL")->required();
  a->source.add_to(*command, "source", "");
  a->coated.add_to(*command);
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a] { coat(*a); });
}

}  // namespace lapwing::cli
