#include <filesystem>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "flag_visitor.h"
#include "lapwing/json/parse_json.h"
#include "lapwing/recipe/step.h"

// Adds the commands that edit meshes. `run` reads a recipe. The other commands, one for each
// operation, build a recipe from their flags.
namespace lapwing::cli {
namespace {

struct StepArguments {
  StepFiles files;
  EditOutput output;
  std::shared_ptr<StepDraft> draft = std::make_shared<StepDraft>();
};

// Builds a recipe with one step and runs it, so that flags and recipes share their code and their
// messages. Throws CLI::RequiredError if the command would write no file.
void run_step(const std::string& command, const StepArguments& a) {
  const EditOutput& output = a.output;
  if (output.save.empty() && output.render.empty() && a.files.recipe.empty() &&
      output.report.empty()) {
    throw CLI::RequiredError("one of --save, --render, --report and --recipe");
  }
  nlohmann::ordered_json step = a.draft->json;
  for (const auto& [place, value] : a.draft->given) step[place] = value;
  for (const auto& finish : a.draft->at_end) finish(step, a.files);
  nlohmann::ordered_json json = {{"lapwing", kRecipeVersion},
                                 {"mesh", a.files.from_recipe(a.files.mesh)},
                                 {"steps", nlohmann::ordered_json::array({step})}};
  if (!output.save.empty()) json["save"] = a.files.from_recipe(output.save);
  const Recipe parsed = parse_recipe(JsonNode::Document{std::move(json)}, a.files.recipe_folder(),
                                     "flags of lapwing " + command);
  output.run(parsed, {}, a.files.recipe);
}

void add_step(CLI::App& app, const Operation& operation) {
  const std::string name(operation.name);
  auto* command = app.add_subcommand(name, std::string(operation.help) + ", by flags");
  auto a = std::make_shared<StepArguments>();
  a->draft->json["op"] = name;
  command->add_option("MESH", a->files.mesh, std::string("the mesh to edit: ") + kMeshHelp)
      ->required();
  FlagVisitor flags(*command, a->draft);
  Step step = operation.step;
  describe(step, flags);
  command->add_option("--recipe", a->files.recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a, name] { run_step(name, *a); });
}

}  // namespace

void add_run(CLI::App& app) {
  auto* command = app.add_subcommand("run", "run a recipe: a whole edit in one JSON file");
  auto recipe = std::make_shared<std::string>();
  auto output = std::make_shared<EditOutput>();
  command->add_option("RECIPE", *recipe, "JSON; its paths are relative to its folder")->required();
  output->add_to(*command);
  command->add_option("--sandbox", output->sandbox,
                      "refuse a recipe that reads or writes outside this folder; paths given by "
                      "flags are not restricted");
  command->callback([recipe, output] { output->run(read_recipe(*recipe), *recipe, {}); });
}

void add_steps(CLI::App& app) {
  for (const Operation& operation : operations()) {
    // These operations have their own commands, because the commands also write or print other
    // results. The command of `fill_holes` is `check`.
    constexpr std::array<std::string_view, 5> kOthers{"peel", "remesh", "subdivide", "fill_holes",
                                                      "wrap"};
    if (std::ranges::find(kOthers, operation.name) == kOthers.end()) add_step(app, operation);
  }
}

}  // namespace lapwing::cli
