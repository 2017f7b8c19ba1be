#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "handle_flags.h"
#include "region_text.h"
#include "step_flags.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

struct DeformArguments {
  std::string mesh;
  std::string roi = "all";
  std::string belt = "fraction:0.1";
  HandleFlags handle;
  std::string weights = "cotangent";
  double detail_length = DeformParameters{}.detail_length;
  std::string response = "tangent";
  double constraint_weight = DeformParameters{}.constraint_weight;
  bool hard = false;
  bool no_settle = false;
  int max_iterations = SettleOptions{}.max_iterations;
  std::optional<double> commit_every;
  std::string recipe;
  EditOutput output;
};

Json settle_json(const DeformArguments& a) {
  if (a.no_settle) return false;
  return {{"max_iterations", a.max_iterations}};
}

Json step_json(const DeformArguments& a) {
  Json step = {{"op", "deform"},
               {"roi", region_json("--roi", a.roi)},
               {"belt", region_json("--belt", a.belt)},
               {"handles", Json::array({a.handle.json()})},
               {"weights", a.weights},
               {"detail_length", a.detail_length},
               {"response", a.response},
               {"constraint_weight", a.constraint_weight},
               {"hard", a.hard},
               {"settle", settle_json(a)}};
  if (a.commit_every) step["commit_every"] = *a.commit_every;
  return step;
}

void deform(const DeformArguments& a) {
  const StepFlags flags{"deform", a.mesh, a.recipe, a.output};
  flags.run(step_json(a));
}

}  // namespace

void add_deform(CLI::App& app) {
  auto* command = app.add_subcommand("deform", "one deformation by flags: a region with a handle");
  auto a = std::make_shared<DeformArguments>();
  command->add_option("MESH", a->mesh, "OBJ, OFF, PLY or STL")->required();
  command->add_option("--roi", a->roi, kRegionHelp)->capture_default_str();
  command
      ->add_option("--belt", a->belt,
                   std::string("stationary anchors: fraction:F | ") + kRegionHelp)
      ->capture_default_str();
  a->handle.add_to(*command)->required();
  command->add_option("--weights", a->weights)
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  command->add_option("--constraint-weight", a->constraint_weight)->capture_default_str();
  command->add_flag("--hard", a->hard, "hold belt and handle exactly");
  command
      ->add_option(
          "--detail-length", a->detail_length,
          "below it details are kept as they are, above it the surface is elastic: a share "
          "of the region's radius, the root mean square distance of its surface from its centroid")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--response", a->response, "the linear response: of the energy, or the paper's")
      ->check(CLI::IsMember({"tangent", "rsi"}))
      ->capture_default_str();
  auto* no_settle = command->add_flag("--no-settle", a->no_settle,
                                      "leave the linear response, right for small angles only");
  command->add_option("--max-iterations", a->max_iterations, "of settling")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->excludes(no_settle);
  command->add_option("--commit-every", a->commit_every,
                      "DEGREES up to 180: make a larger turn in parts, each the rest of the next");
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a] { deform(*a); });
}

}  // namespace lapwing::cli
