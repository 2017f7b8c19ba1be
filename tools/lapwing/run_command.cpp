#include <memory>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"

namespace lapwing::cli {

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

}  // namespace lapwing::cli
