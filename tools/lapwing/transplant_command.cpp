#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "edit_output.h"
#include "move_flags.h"
#include "region_text.h"
#include "step_flags.h"

namespace lapwing::cli {
namespace {

using Json = nlohmann::ordered_json;

struct TransplantArguments {
  std::string mesh;
  std::string part;
  std::string part_region;
  std::optional<Index> loop;
  MoveFlags move;
  bool snap = false;
  std::optional<double> fit_degrees;
  std::optional<double> fit_scale;
  bool keep_size = false;
  std::string target_region;
  std::optional<double> transition_width;
  std::string transition_profile = "smooth";
  std::optional<double> padding;
  std::optional<double> belt;
  std::string weights = "cotangent";
  std::string sampling = "linear";
  bool no_remesh = false;
  std::string recipe;
  EditOutput output;
};

Json place_json(const TransplantArguments& a) {
  const bool fitted = a.fit_degrees || a.fit_scale || a.keep_size;
  const bool moved = a.move.are_given() || a.snap;
  if (moved && fitted) {
    throw CLI::ExcludesError("--fit-rotate, --fit-scale and --keep-size",
                             "--translate, --rotate, --scale, --pivot, --matrix and --snap");
  }
  if (moved) return a.move.json();
  Json fit = Json::object();
  if (a.fit_degrees) fit["rotate_degrees"] = *a.fit_degrees;
  if (a.fit_scale) fit["scale"] = *a.fit_scale;
  if (a.keep_size) fit["keep_size"] = true;
  return {{"auto", fit}};
}

Json step_json(const TransplantArguments& a, const StepFlags& flags) {
  Json part;
  if (!a.part.empty()) part["mesh"] = flags.from_recipe(a.part);
  if (!a.part_region.empty()) part["region"] = region_json("--part-region", a.part_region);
  if (part.empty()) throw CLI::RequiredError("--part or --part-region");
  Json step = {{"op", "transplant"}, {"part", part}};
  if (a.loop) step["loop"] = *a.loop;
  step["place"] = place_json(a);
  if (a.snap) step["snap"] = true;
  step["target_region"] = region_json("--target-region", a.target_region);
  if (a.transition_width) {
    step["transition"] = {{"width", *a.transition_width}, {"profile", a.transition_profile}};
  }
  if (a.padding) step["belt"]["padding"] = *a.padding;
  if (a.belt) step["belt"]["width"] = *a.belt;
  step["weights"] = a.weights;
  step["sampling"] = a.sampling;
  step["remesh"] = a.no_remesh ? "none" : "auto";
  return step;
}

void transplant(const TransplantArguments& a) {
  const StepFlags flags{"transplant", a.mesh, a.recipe, a.output};
  flags.run(step_json(a, flags));
}

void add_place_options(CLI::App& command, TransplantArguments& a) {
  a.move.add_to(command, "the part", "the centre of its loop");
  command.add_flag("--snap", a.snap, "then bring its loop onto the surface, by the least motion");
  command.add_option("--fit-rotate", a.fit_degrees,
                     "DEGREES about the hole's normal, after the part was fitted to the hole by "
                     "itself, as it is without a motion");
  command.add_option("--fit-scale", a.fit_scale, "likewise, about the hole's centre")
      ->check(CLI::PositiveNumber);
  command.add_flag("--keep-size", a.keep_size, "fit the part without scaling it");
}

}  // namespace

void add_transplant(CLI::App& app) {
  auto* command = app.add_subcommand("transplant", "put a part of one mesh on another, by flags");
  auto a = std::make_shared<TransplantArguments>();
  command->add_option("MESH", a->mesh, "what the part is put on: OBJ, OFF, PLY or STL")->required();
  command->add_option("--part", a->part,
                      "a mesh with a boundary loop; with --part-region any mesh, MESH itself if "
                      "not given");
  command->add_option("--part-region", a->part_region, kRegionHelp);
  command->add_option("--loop", a->loop,
                      "which boundary loop of the part is sewn on; the longest if not given");
  add_place_options(*command, *a);
  command->add_option("--target-region", a->target_region, kRegionHelp)->required();
  auto* width = command->add_option("--transition", a->transition_width,
                                    "length over which the detail goes over into the part's; half "
                                    "the hole's radius if not given");
  width->check(CLI::NonNegativeNumber);
  command->add_option("--profile", a->transition_profile, "of the transition")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->capture_default_str()
      ->needs(width);
  command->add_option("--padding", a->padding, "length beyond it that is free on both sides")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--belt", a->belt, "length beyond that which is held")
      ->check(CLI::PositiveNumber);
  command->add_option("--weights", a->weights)
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  command->add_option("--sampling", a->sampling, "of the Laplacians of what is cut out")
      ->check(CLI::IsMember({"one_ring", "linear"}))
      ->capture_default_str();
  command->add_flag("--no-remesh", a->no_remesh,
                    "keep the triangles around the seam, however uneven they are");
  command->add_option("--recipe", a->recipe, "write this edit as a recipe");
  a->output.add_to(*command);
  command->callback([a] { transplant(*a); });
}

}  // namespace lapwing::cli
