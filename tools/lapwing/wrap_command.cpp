#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "flag_visitor.h"
#include "region_text.h"

namespace lapwing::cli {
namespace {

struct WrapArguments {
  StepFiles files;
  std::string scan;
  std::vector<std::string> landmarks;
  bool aligned = false;
  bool hard = false;
  bool detail = false;
  std::string mirror;
  EditOutput output{.device = "cpu"};
};

void wrap_mesh(const WrapArguments& a) {
  WrapStep step{.scan = a.files.from_recipe(a.scan),
                .aligned = a.aligned,
                .hard = a.hard,
                .detail = a.detail};
  if (!a.mirror.empty()) step.mirror = mirror_spec("--mirror", a.mirror);
  if (!a.landmarks.empty()) step.landmarks.file = a.files.from_recipe(a.landmarks[0]);
  if (a.landmarks.size() > 1) step.landmarks.scan_file = a.files.from_recipe(a.landmarks[1]);
  const Recipe recipe{.mesh = a.files.from_recipe(a.files.mesh),
                      .steps = {step},
                      .save = a.files.from_recipe(a.output.save),
                      .base_directory = a.files.recipe_folder()};
  a.output.run(recipe, {}, a.files.recipe);
}

}  // namespace

void add_wrap(CLI::App& app) {
  auto* command = app.add_subcommand(
      "wrap",
      "deforms a template so that it covers a scan; the result keeps the template's triangles");
  auto a = std::make_shared<WrapArguments>();
  command->add_option("TEMPLATE", a->files.mesh, kMeshHelp)->required();
  command->add_option("SCAN", a->scan, kMeshHelp)->required();
  command
      ->add_option("--landmarks", a->landmarks,
                   "a table (.csv, .txt, .npy) or list (.json) of corresponding points; or two "
                   "files of points with labels, on the template and on the scan (.fcsv, "
                   ".mrk.json, .csv)")
      ->type_name("FILE [SCAN_FILE]")
      ->expected(1, 2);
  command->add_flag("--aligned", a->aligned,
                    "the template is already in place; do not align it first");
  command->add_flag("--hard", a->hard, "reach the landmarks exactly");
  command->add_option(
      "--mirror", a->mirror,
      std::string(kMirrorHelp) +
          ": the plane in which the template is symmetric; the result is symmetric, too");
  command->add_flag("--detail", a->detail,
                    "at the end, move each vertex that has a counterpart exactly onto the scan");
  command->add_option("--recipe", a->files.recipe, "write this wrap as a recipe");
  a->output.add_to(*command, "-o,--output,--save")->required();
  command->callback([a] { wrap_mesh(*a); });
}

}  // namespace lapwing::cli
