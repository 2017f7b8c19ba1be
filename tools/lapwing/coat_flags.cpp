#include "coat_flags.h"

#include <CLI/CLI.hpp>

#include "region_text.h"

namespace lapwing::cli {
namespace {

void add_pairs(CLI::App& command, const std::string& flag, std::vector<std::vector<Index>>& pairs,
               const std::string& help) {
  command.add_option(flag, pairs, help)->delimiter(',')->type_size(2)->expected(-1);
}

}  // namespace

void SourceFlags::add_to(CLI::App& command, const std::string& name, const std::string& prefix) {
  const std::string flag = "--" + prefix;
  command.add_option("--" + name, mesh, "the mesh with the detail; MESH itself if not given");
  command.add_option("--" + name + "-patch", patch, kRegionHelp)->capture_default_str();
  command
      .add_option(flag + "detail-size", detail_size,
                  "length on the source: what is smaller is carried over")
      ->required()
      ->check(CLI::PositiveNumber);
  add_pairs(
      command, flag + "boundary-pair", boundary_pairs,
      "S,T: vertices of the two borders that belong together; one for the disk, four in order "
      "for the square; chosen and reported if not given");
  add_pairs(command, flag + "inner-pair", inner_pairs,
            "S,T: vertices inside that belong together; repeat");
  command.add_option(flag + "sampling", sampling, "of the source's Laplacians")
      ->check(CLI::IsMember({"one_ring", "linear"}))
      ->capture_default_str();
  command
      .add_option(flag + "scale", scale, "of the detail; the local ratio of lengths if not given")
      ->check(CLI::PositiveNumber);
  command
      .add_option(flag + "amplitude", amplitude,
                  "of the detail: 0 leaves the target, negative engraves")
      ->capture_default_str();
}

void SourceFlags::write(nlohmann::ordered_json& json) const {
  json["detail_size"] = detail_size;
  json["boundary_pairs"] = boundary_pairs;
  json["inner_pairs"] = inner_pairs;
  json["sampling"] = sampling;
  if (scale) json["scale"] = *scale;
  json["amplitude"] = amplitude;
}

void CoatedFlags::add_to(CLI::App& command) {
  command.add_option("--target-patch", target_patch, kRegionHelp)->capture_default_str();
  command
      .add_option("--smooth-target", smooth_target,
                  "length: the target's own features below it go first")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--weights", weights)
      ->check(CLI::IsMember({"uniform", "cotangent"}))
      ->capture_default_str();
  command.add_option("--domain", domain, "what patches are laid into")
      ->check(CLI::IsMember({"disk", "square"}))
      ->capture_default_str();
  auto* width = command.add_option("--transition", transition_width,
                                   "length over which the detail fades in from the border; about "
                                   "the detail size if not given");
  width->check(CLI::NonNegativeNumber);
  command.add_option("--profile", transition_profile, "of the transition")
      ->check(CLI::IsMember({"smooth", "linear"}))
      ->capture_default_str()
      ->needs(width);
  command.add_flag("--no-remesh", no_remesh,
                   "keep the target's triangles, however coarse they are");
}

void CoatedFlags::write(nlohmann::ordered_json& step) const {
  step["target_patch"] = region_json("--target-patch", target_patch);
  step["smooth_target"] = smooth_target;
  step["weights"] = weights;
  step["domain"] = domain;
  if (transition_width) {
    step["transition"] = {{"width", *transition_width}, {"profile", transition_profile}};
  }
  step["remesh"] = no_remesh ? "none" : "auto";
}

}  // namespace lapwing::cli
