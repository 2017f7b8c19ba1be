#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "flag_visitor.h"
#include "lapwing/step/step.h"

namespace lapwing::cli {
namespace {

struct StepArguments {
  std::string mesh;
  std::string recipe;
  EditOutput output;
  std::shared_ptr<StepDraft> draft = std::make_shared<StepDraft>();
};

void add_step(CLI::App& app, const Operation& operation) {
  const std::string name(operation.name);
  auto* command = app.add_subcommand(name, std::string(operation.help) + ", by flags");
  auto a = std::make_shared<StepArguments>();
  a->draft->json["op"] = name;
  command->add_option("MESH", a->mesh, "the mesh to edit: OBJ, OFF, PLY, STL or glTF")->required();
  FlagVisitor flags(*command, a->draft);
  Step step = operation.step;
  describe(step, flags);
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a, name] { StepFlags{name, a->mesh, a->recipe, a->output}.run(*a->draft); });
}

}  // namespace

void add_steps(CLI::App& app) {
  for (const Operation& operation : operations()) {
    // add_peel adds `lapwing peel`, which also writes the coating.
    if (operation.name != words_of(static_cast<const PeelRequest*>(nullptr)).name) {
      add_step(app, operation);
    }
  }
}

}  // namespace lapwing::cli
